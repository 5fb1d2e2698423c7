/// What `portrait query` says of settings that were found, as JSON for programs and as text for people.
#pragma once

#include <string>
#include <vector>

#include "portraits/query/query.h"
#include "tools/output.h"

namespace portrait::tools {

/// {"settings", "objective", "measures", "status"[, "controller" when there is a plant]}
Json json_found(const Grid& grid, const QueryUnits& units, const Found& found);

/// {"unstable", "not_settled", "not_computed", "objective_missing"}: how many settings each.
Json json_left_out(const LeftOut& left_out);

/// {"family", "K", "Td"[, "T1"]}
Json json_plant(const RealPlant& plant);

/// "units", "steps", "plant" and, for every constraint, what its numbers are.
void add_units(Json& json, const Grid& grid, const Conditions& conditions);

/// Which unit each bound is in, a line each: "  IAE_d <= 3   IAE_d: real, unit of y times time, for ..."
std::string units_text(const Grid& grid, const Conditions& conditions);

/// "kappa=0.24 tau_i=8 delta=0.7"
std::string setting_text(const Grid& grid, const Found& found);

/// The controller for the plant, when there is one, and the table of measures.
std::string found_text(const Grid& grid, const QueryUnits& units, const Found& found);

/// A head and a row for each setting: parameters, objective, status, measures.
std::string csv_text(const Grid& grid, const std::vector<Found>& rows);

/// "real units, steps w = 2, d = 1" or "normalised"
std::string unit_note(const QueryUnits& units);

}  // namespace portrait::tools
