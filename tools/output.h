/// What the program says of settings, measures and controllers: as JSON for programs, as tables for people.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/loop/forms.h"
#include "engine/loop/loop.h"
#include "engine/loop/real_plant.h"
#include "engine/measures/catalogue.h"

namespace portrait::tools {

/// Keys in the order in which they were added.
using Json = nlohmann::ordered_json;

/// A number; null for NaN, the strings "inf" and "-inf" for what JSON has no number for.
Json json_number(double value);

/// {"kappa": 0.24, "tau_i": 8.0, ...}: every parameter the family has, tau_d as well as delta.
Json json_settings(const Loop& loop);
/// {"IAE_w": 8.0, ...}: the given measures, null where one does not exist.
Json json_measures(const MeasureRow& row, const std::vector<Measure>& measures);
/// {"parallel": {...}, "standard": {...}, "series": {...} or null, "filter": ..., "prefilter": ...}
Json json_controller(const RealController& controller, const LoopFamily& family);

/// To stdout, one object, with a newline.
void print_json(const Json& json);
/// To stdout.
void print_text(const std::string& text);
/// To stderr, behind "portrait: ".
void print_message(const std::string& text);

/// Six significant digits: enough to read, not to compute with.
std::string short_number(double value);

/// All measures but those under noise, which a sweep keeps over several seeds.
std::vector<Measure> measures_of_one_run();

/// The measures of both steps side by side, with IAE, TV, ... as rows and Ms, Mt below.
/// `unit_note` stands in the head: "normalised" or the units of a plant.
std::string measures_table(const MeasureRow& row, const std::vector<Measure>& measures,
                           const std::string& unit_note);

/// The three forms with their formulas, filter and prefilter, one a line, each behind two spaces.
std::string controller_text(const RealController& controller, const LoopFamily& family);

/// "K = 2.5, Td = 0.4": the plant with its transfer function.
std::string plant_text(const RealPlant& plant);

}  // namespace portrait::tools
