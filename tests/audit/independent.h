/// All measures of one loop by other means than the engine's: neither its kernel nor its reference.
///
///     responses   the method of steps on power series, in long double (tests/oracle/method_of_steps.h)
///     margins     a walk along the frequency axis, C Q P evaluated as it is written; what it brackets located in long double
///     stability   the argument principle on a contour walked step by step (tests/engine/loop/root_count.h)
///
/// accuracy  rounding of long double, but for what a raster misses: a pair of extremes closer than 1/256 of a piece, a pair of
///           crossovers closer than a step. `fineness` 4 makes both four times finer.
/// unit      normalised
#pragma once

#include "engine/base/status.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"

namespace portrait::audit {

struct Independent {
  Status status = Status::not_computed;
  MeasureRow measures;  ///< IAE_w .. u_max_d, Ms, Mt, GM, GM_low, PM, DM
};

/// Whether every root of the characteristic quasi-polynomial lies in the open left half-plane.
bool is_stable_by_contour(const Loop& loop);

/// REQUIRES: the loop is valid and stable; dead_times >= 1.
Independent measured_independently(const Loop& loop, int dead_times, int fineness = 1);

}  // namespace portrait::audit
