/// The open loop's factors as plain numbers: those of engine/loop/open_loop.h without its vector of lags, for code that
/// looks at every setting of a sweep.
#pragma once

#include "engine/loop/loop.h"

namespace portrait::kernel {

/// N(s) = n0 + n1 s + n2 s^2, none below 0, over s^integrators and the lags.
struct Numerator {
  double n0, n1, n2;
  int integrators;
};

inline Numerator numerator_of(const LoopFamily& family, const Setting& s) {
  const int k = integrators(family.plant);
  if (has_integral_action(s)) return {s.kappa / s.tau_i, s.kappa, s.delta, k + 1};
  return {s.kappa, s.delta, 0, k};
}

/// |L(j omega)|^2
inline double gain_squared_at(const Loop& loop, double omega) {
  const Setting& s = loop.setting;
  const Numerator N = numerator_of(loop.family, s);
  const double x = omega * omega, real = N.n0 - N.n2 * x;
  double gain = real * real + N.n1 * N.n1 * x;
  for (int i = 0; i < N.integrators; ++i) gain /= x;
  if (loop.family.plant == Plant::fotd) gain /= 1 + s.tau_1 * s.tau_1 * x;
  for (int i = 0; i < loop.family.n; ++i) gain /= 1 + s.tau_f * s.tau_f * x;
  return gain;
}

}  // namespace portrait::kernel
