/// Seeded stable loops of the wider family: plants of many lags, controllers given by their gains.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/oracle/random_loops.h"

namespace portrait::oracle {

/// Zeros of the controller near the plant's poles, as the tuning rules of these families place them.
inline void add_gains(Random& random, int m, double lag, Setting& s) {
  const double zero = lag * random.uniform(0.5, 1.1);
  double K = random.log_uniform(0.1, 0.7) / (1 + lag);
  for (int i = 0; i <= m + 1; ++i) {
    s.gains[static_cast<std::size_t>(i)] = K * random.uniform(0.8, 1.2);
    K *= zero * (m + 1 - i) / (i + 1);
  }
  if (random.chance(0.15) && m >= 0) s.gains[0] = 0;
}

inline void add_pid(Random& random, double lag, Setting& s) {
  s.kappa = random.log_uniform(0.1, 1.5),
  s.tau_i = random.chance(0.8) ? (1 + lag) * random.log_uniform(0.4, 3) : kInf;
  s.delta = random.chance(0.8) ? s.kappa * random.log_uniform(0.1, 0.8) * (0.3 + lag) : 0;
}

/// What a step of the setpoint sends through the derivatives. Beyond this the states of the reference, derivatives of the
/// filter's output, are so large that its own rounding shows in TV; the kernel's states are not.
inline constexpr double kLargestKick = 3e3;

inline bool kicks_too_hard(const Loop& loop) {
  const auto K = gains_of(loop);
  double kick = 0;
  for (int k = 1; k <= kMaxGainOrder; ++k)
    if (loop.family.n > 0)
      kick = std::max(kick, std::abs(K[static_cast<std::size_t>(k) + 1]) / std::pow(loop.setting.tau_f, k));
  return kick > kLargestKick;
}

inline Loop random_cascade(Random& random) {
  while (true) {
    Loop loop;
    LoopFamily& f = loop.family;
    Setting& s = loop.setting;
    f.plant = random.chance(0.75) ? Plant::jotd : static_cast<Plant>(random.below(3));
    const bool gains = f.plant != Plant::jotd || random.chance(0.6);
    f.j = f.plant == Plant::jotd ? 1 + random.below(kMaxPlantOrder) : 0;
    const double lag = random.log_uniform(0.05, 3);
    if (f.plant == Plant::jotd) s.tau_j = lag;
    if (f.plant == Plant::fotd) s.tau_1 = lag;
    f.m = gains ? random.below(std::min(f.plant == Plant::jotd ? f.j + 1 : 3, 7)) : -1;
    f.n = gains ? f.m + random.below(3) : random.below(4);
    f.prefilter = gains ? Prefilter::none : static_cast<Prefilter>(random.below(3));
    if (f.n > 0) s.tau_f = random.log_uniform(0.02, 0.5);
    if (gains)
      add_gains(random, f.m, lag, s);
    else
      add_pid(random, lag, s), add_weights(random, f.prefilter, s);
    if (!why_invalid(loop) && !kicks_too_hard(loop) && is_stable(open_loop(loop))) return loop;
  }
}

}  // namespace portrait::oracle
