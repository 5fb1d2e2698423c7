/// A plant in real units on a command line: --plant WORD --K .. --Td .. --T1 .. --j .. --Tj .., or tf:NUM/DEN.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "engine/rules/rule.h"

namespace portrait::tools {

/// The line as typed; empty means not given.
struct PlantArguments {
  std::string plant, K, Td, T1, j, Tj;
};

void add_plant_options(CLI::App& verb, PlantArguments& arguments);

/// dipdt, ipdt, fotd, jotd, tf:NUM/DEN. K is 1 without it, Td 1 (tf: 0). Throws InputError.
rules::RulePlant plant_argument(const PlantArguments& arguments);

/// "34/13.5,54.25,55,1": coefficients from the highest power down, as gain, integrators, zeros and poles; the denominator in
/// one factor. Throws InputError with the option's name.
rules::RulePlant transfer_function_argument(std::string_view option, std::string_view text);

/// "K e^(-Td s)/s, K = 2, Td = 0.5".
std::string rule_plant_text(const rules::RulePlant& plant);

}  // namespace portrait::tools
