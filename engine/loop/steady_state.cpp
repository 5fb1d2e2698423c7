#include "engine/loop/steady_state.h"

#include <algorithm>
#include <cmath>

namespace portrait {
namespace {

/// c s^k, what a rational function comes to near s = 0.
struct Lowest {
  double c = 1;
  int k = 0;
};

Lowest operator*(const Lowest& f, const Lowest& g) { return {f.c * g.c, f.k + g.k}; }
Lowest operator/(const Lowest& f, const Lowest& g) { return {f.c / g.c, f.k - g.k}; }

Lowest lowest(const Polynomial& p) {
  const auto first = std::find_if(p.begin(), p.end(), [](double a) { return a != 0; });
  if (first == p.end()) return {0, 0};
  return {*first, static_cast<int>(first - p.begin())};
}

Lowest lowest(const Polynomial& N, const std::vector<Polynomial>& D) {
  Lowest found = lowest(N);
  for (const Polynomial& factor : D) found = found / lowest(factor);
  return found;
}

Lowest one_plus(const Lowest& L) {
  if (L.k < 0) return L;
  return {L.k == 0 ? 1 + L.c : 1, 0};
}

double limit(const Lowest& f) {
  if (f.c == 0 || f.k > 0) return 0;
  return f.k == 0 ? f.c : std::copysign(kInf, f.c);
}

/// The transfer functions of the loop near s = 0.
struct AtRest {
  explicit AtRest(const GeneralLoop& loop)
      : P(lowest(loop.plant.rational.numerator, loop.plant.rational.denominator)),
        C(lowest(loop.controller.on_output, loop.controller.denominator)),
        from_w(lowest(loop.controller.on_setpoint, loop.controller.denominator) *
               lowest(loop.controller.prefilter.numerator, loop.controller.prefilter.denominator)),
        one_plus_L(one_plus(P * C)) {}
  Lowest P, C, from_w, one_plus_L;
};

}  // namespace

SteadyState rest_after_setpoint_step(const Loop& loop) {
  if (!is_basic(loop.family)) return rest_after_setpoint_step(general(loop));
  if (integrators(loop.family.plant) > 0) return {.y = 1, .u = 0};
  const double kappa = loop.setting.kappa;
  const double y = has_integral_action(loop.setting) ? 1 : kappa / (1 + kappa);
  return {.y = y, .u = y};
}

SteadyState rest_after_disturbance_step(const Loop& loop) {
  if (!is_basic(loop.family)) return rest_after_disturbance_step(general(loop));
  const double kappa = loop.setting.kappa;
  if (has_integral_action(loop.setting)) return {.y = 0, .u = -1};
  if (integrators(loop.family.plant) > 0) return {.y = 1 / kappa, .u = -1};
  return {.y = 1 / (1 + kappa), .u = -kappa / (1 + kappa)};
}

SteadyState rest_after_output_step(const Loop& loop) {
  if (!is_basic(loop.family)) return rest_after_output_step(general(loop));
  const double kappa = loop.setting.kappa;
  if (integrators(loop.family.plant) > 0) return {.y = 0, .u = 0};
  if (has_integral_action(loop.setting)) return {.y = 0, .u = -1};
  return {.y = 1 / (1 + kappa), .u = -kappa / (1 + kappa)};
}

SteadyState rest_after_setpoint_step(const GeneralLoop& loop) {
  const AtRest at(loop);
  return {.y = limit(at.P * at.from_w / at.one_plus_L), .u = limit(at.from_w / at.one_plus_L)};
}

SteadyState rest_after_disturbance_step(const GeneralLoop& loop) {
  const AtRest at(loop);
  return {.y = limit(at.P / at.one_plus_L), .u = -limit(at.C * at.P / at.one_plus_L)};
}

SteadyState rest_after_output_step(const GeneralLoop& loop) {
  const AtRest at(loop);
  return {.y = limit(Lowest{} / at.one_plus_L), .u = -limit(at.C / at.one_plus_L)};
}

}  // namespace portrait
