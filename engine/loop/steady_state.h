/// Where a stable closed loop comes to rest after a unit step.
///
/// unit      normalised
#pragma once

#include "engine/loop/loop.h"

namespace portrait {

struct SteadyState {
  double y, u;
};

/// For w = 1. REQUIRES: the loop is valid and stable.
SteadyState rest_after_setpoint_step(const Loop& loop);
/// For d = 1. REQUIRES: as above.
SteadyState rest_after_disturbance_step(const Loop& loop);

}  // namespace portrait
