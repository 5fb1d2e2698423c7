#include "engine/loop/steady_state.h"

namespace portrait {

SteadyState rest_after_setpoint_step(const Loop& loop) {
  if (integrators(loop.family.plant) > 0) return {.y = 1, .u = 0};
  const double kappa = loop.setting.kappa;
  const double y = has_integral_action(loop.setting) ? 1 : kappa / (1 + kappa);
  return {.y = y, .u = y};
}

SteadyState rest_after_disturbance_step(const Loop& loop) {
  const double kappa = loop.setting.kappa;
  if (has_integral_action(loop.setting)) return {.y = 0, .u = -1};
  if (integrators(loop.family.plant) > 0) return {.y = 1 / kappa, .u = -1};
  return {.y = 1 / (1 + kappa), .u = -kappa / (1 + kappa)};
}

}  // namespace portrait
