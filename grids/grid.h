/// A grid: everything that says which loops a sweep simulates and what it keeps of them.
///
/// Settings are numbered 0 .. setting_count - 1, the last axis fastest (row-major), as in a portrait.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/loop/noise.h"
#include "engine/measures/catalogue.h"
#include "grids/axis.h"

namespace portrait {

enum class Precision { real64, real32 };  ///< "double", "single" in grid files: how measures are stored

/// A parameter with the same value in every setting.
struct FixedParameter {
  Parameter parameter;
  double value;
};

struct Grid {
  std::string title;
  LoopFamily family;
  Horizon horizon;
  std::optional<double> sampling;  ///< dead times over which noise is held: there when noise_gain is kept
  std::optional<NoiseTrials> noise =
      std::nullopt;  ///< held over `sampling`; then the horizon is fixed and every controller proper
  Precision precision = Precision::real64;
  std::vector<Measure> measures;      ///< kept ones, in catalogue order
  std::vector<Axis> axes;             ///< in the order of the grid file; a single setting has none
  std::vector<FixedParameter> fixed;  ///< the family's other parameters, in order; either delta or tau_d
  std::string text;                   ///< the grid file, byte for byte
};

/// Product of the axes' sizes; 1 for a grid without axes. REQUIRES: below 2^63, which the reader has checked.
std::uint64_t setting_count(const Grid& grid);

/// Index along each axis of setting `number`.
std::vector<std::uint64_t> coordinates(const Grid& grid, std::uint64_t number);

/// The setting with these values along the axes: fixed values, then axes, tau_d last since it needs kappa.
Setting setting_with(const Grid& grid, const std::vector<double>& values);

/// The setting at these coordinates.
Setting setting_at(const Grid& grid, const std::vector<std::uint64_t>& coordinates);
Setting setting_at(const Grid& grid, std::uint64_t number);

}  // namespace portrait
