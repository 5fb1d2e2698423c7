/// Where a stable closed loop comes to rest after a unit step.
///
/// unit      normalised
#pragma once

#include "engine/loop/general_loop.h"
#include "engine/loop/loop.h"

namespace portrait {

struct SteadyState {
  double y, u;
};

/// For w = 1. REQUIRES: the loop is valid and stable.
SteadyState rest_after_setpoint_step(const Loop& loop);
/// For d = 1. REQUIRES: as above.
SteadyState rest_after_disturbance_step(const Loop& loop);
/// For a step of 1 on the output. REQUIRES: as above.
SteadyState rest_after_output_step(const Loop& loop);

SteadyState rest_after_setpoint_step(const GeneralLoop& loop);
SteadyState rest_after_disturbance_step(const GeneralLoop& loop);
SteadyState rest_after_output_step(const GeneralLoop& loop);

}  // namespace portrait
