/// Settings between and beyond those of the grid, measured by the engine as the portrait's were: same family, horizon and
/// sampling. What refining, robust answers and questions about a given setting are made of.
///
/// unit      measures in the units given with each setting, so that settings of different plants can be compared
/// accuracy  that of the engine (engine/kernel/responses.h); a setting of the grid gives what the portrait stores
/// cost      microseconds a setting; several threads above kSettingsPerThread
#pragma once

#include <span>
#include <vector>

#include "engine/base/status.h"
#include "grids/grid.h"
#include "portraits/query/expression.h"
#include "portraits/query/query_units.h"

namespace portrait {

inline constexpr std::size_t kSettingsPerThread = 64;

struct Measured {
  Setting setting;
  Status status = Status::not_computed;
  MeasureRow measures;             ///< in its units
  std::optional<RealPlant> plant;  ///< whose controller the setting is, for Kc, Ti, ...
};

/// REQUIRES: settings valid for the grid's family.
std::vector<Measured> measure(const Grid& grid, const QueryUnits& units, std::span<const Setting> settings,
                              int threads = 1);

/// The value of an expression at a measured setting. REQUIRES: require_available(expression, grid, has a plant).
double value_at(const Expression& expression, const Measured& measured);

}  // namespace portrait
