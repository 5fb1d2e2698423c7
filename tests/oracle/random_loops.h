/// Seeded stable loops of all plants, controllers, filters and prefilters, over the ranges the reference simulation
/// promises its accuracy for: tau_f 1e-4 .. 1, tau_1 0.01 .. 100, n = 0 .. 4.
#pragma once

#include <algorithm>

#include "engine/loop/loop.h"
#include "engine/loop/stability.h"
#include "tests/oracle/random.h"

namespace portrait::oracle {

/// kappa, tau_i, delta spread over the stable region's neighbourhood of each plant.
inline Setting random_controller(Random& random, Plant plant, double tau_1) {
  const bool integral = random.chance(0.75), derivative = plant == Plant::dipdt || random.chance(0.7);
  const double lag = plant == Plant::fotd ? tau_1 : 0;
  Setting s;
  if (plant == Plant::dipdt) s = {.kappa = random.log_uniform(0.005, 0.3), .tau_i = random.log_uniform(5, 100)};
  if (plant == Plant::ipdt) s = {.kappa = random.log_uniform(0.05, 1.2), .tau_i = random.log_uniform(2, 60)};
  if (plant == Plant::fotd)
    s = {.kappa = random.log_uniform(0.05, 1) * (1 + lag), .tau_i = random.log_uniform(0.3, 3) * (1 + lag)};
  s.delta = random.log_uniform(0.05, 0.9) * (plant == Plant::fotd ? lag : 1);
  if (!integral) s.tau_i = kInf;
  if (!derivative) s.delta = 0;
  s.tau_1 = lag;
  return s;
}

inline void add_weights(Random& random, Prefilter prefilter, Setting& s) {
  const bool integral = has_integral_action(s), derivative = s.delta > 0;
  if (prefilter == Prefilter::pi && integral) s.b = random.uniform(0, 1);
  if (prefilter != Prefilter::full) return;
  if (integral) s.b = random.uniform(0, 1) * s.tau_i;
  if (!integral && derivative) s.b = random.uniform(0, 1) * tau_d(s);
  if (integral && derivative) s.c = random.uniform(0, 1) * s.tau_i * tau_d(s);
}

inline Loop random_stable_loop(Random& random, Plant plant, int n, Prefilter prefilter) {
  while (true) {
    Loop loop{{plant, n, prefilter}, random_controller(random, plant, random.log_uniform(0.01, 100))};
    if (n > 0) loop.setting.tau_f = random.log_uniform(1e-4, 1);
    if (random.chance(0.5)) add_weights(random, prefilter, loop.setting);
    if (is_stable(open_loop(loop))) return loop;
  }
}

inline Loop random_stable_loop(Random& random) {
  const auto plant = static_cast<Plant>(random.below(3));
  const int n = random.below(5);
  return random_stable_loop(random, plant, n, static_cast<Prefilter>(random.below(3)));
}

}  // namespace portrait::oracle
