/// Is every setting of a grid a loop that can be simulated? Asked without walking the grid.
///
/// Every rule of `why_invalid(Loop)` is that a parameter lies above 0, not below 0, is finite, or is 0 where
/// another is 0 or inf. On increasing axes a rule that is broken anywhere is broken where each axis has its first
/// or last value: at a corner of the grid. That holds for the product kappa tau_d as well.
/// tests/grids/validity_test.cpp compares with asking every setting, so a rule of another kind is noticed.
#pragma once

#include <optional>
#include <string>

#include "grids/grid.h"

namespace portrait {

struct InvalidSetting {
  Parameter culprit;   ///< a parameter that the grid gives
  std::string reason;  ///< "kappa must be finite and above 0 (it is 0)"
};

/// One setting that cannot be simulated, or nothing. Cost: 2^axes settings, at most 256.
std::optional<InvalidSetting> find_invalid(const Grid& grid);

}  // namespace portrait
