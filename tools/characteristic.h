/// Speed against effort and wobbling of a loop as one number on its line runs: what `portrait characteristic` prints and
/// `portrait plot characteristic` draws.                                                     [Huba2021 (52), 3.6]
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "engine/base/status.h"
#include "tools/simulate_arguments.h"

namespace portrait::tools {

/// The line as typed.
struct CharacteristicArguments {
  SimulateArguments loop;
  std::string vary, speed = "IAE_d", effort = "TV1_ud", wobbling = "TV1_yd";
  double k = 1;
};

/// --plant to --vary, and which measures.
void add_characteristic_options(CLI::App& verb, CharacteristicArguments& a);

struct CharacteristicPoint {
  std::string value;  ///< what {} stood for
  Status status;
  double speed, effort, wobbling, J;
};

/// One for each value of --vary, in its order, simulated by the reference method. Throws InputError.
std::vector<CharacteristicPoint> points_of(const CharacteristicArguments& a);

}  // namespace portrait::tools
