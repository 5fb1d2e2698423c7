/// General loops drawn at random, the same on every machine: every kind of plant and controller of general_loop.h.
#pragma once

#include <algorithm>
#include <vector>

#include "engine/loop/general_loop.h"
#include "tests/oracle/random.h"

namespace portrait::oracle {

/// Multiple lags, real and complex poles with zeros, integrators: degree 1 to 8, gain of either sign.
inline TransferFunction random_plant(Random& random) {
  const double K = random.log_uniform(0.3, 3);
  if (random.chance(0.3)) return multiple_lag(K, random.log_uniform(0.2, 3), 1 + random.below(8));
  TransferFunction P{{K}, {}};
  if (random.chance(0.3)) P.denominator.push_back({0, 1});
  const int real = 1 + random.below(4), pairs = random.below(3), zeros = random.below(3);
  for (int i = 0; i < real; ++i) P.denominator.push_back({1, random.log_uniform(0.1, 5)});
  for (int i = 0; i < pairs; ++i) {
    const double T = random.log_uniform(0.3, 3);
    P.denominator.push_back({1, 2 * random.uniform(0.2, 1.2) * T, T * T});
  }
  for (int i = 0; i < std::min(zeros, real + 2 * pairs); ++i)
    P.numerator = product(P.numerator, {1, random.log_uniform(0.1, 2) * (random.chance(0.3) ? -1 : 1)});
  return random.chance(0.5) ? P : transfer_function(P.numerator, written_out(P.denominator));
}

inline GeneralController random_pid(Random& random) {
  const double Kp = random.log_uniform(0.1, 1), Ti = random.log_uniform(1, 10), TD = random.log_uniform(0.05, 1);
  const int n = 1 + random.below(3);
  GeneralController c = pid_controller(parallel(StandardForm{Kp, Ti, TD}), n, random.log_uniform(0.05, 0.5));
  return random.chance(0.5) ? c : with_weights(c, random.uniform(0, 1), random.uniform(0, 1));
}

inline GeneralController random_gains(Random& random) {
  const int m = random.below(7), n = std::max(1, m + random.below(2));
  std::vector<double> gains;
  double factorial = 1;
  for (int k = -1; k <= m; ++k) {
    gains.push_back(random.uniform(0.1, 0.5) / factorial);
    factorial *= k + 2;
  }
  return gains_controller(gains, n, random.log_uniform(0.1, 0.5));
}

inline GeneralController random_controller(Random& random) {
  GeneralController c = random.chance(0.4) ? random_pid(random)
                        : random.chance(0.5)
                            ? random_gains(random)
                            : controller({scaled(random.log_uniform(0.1, 1), {1, random.log_uniform(0.1, 3)}),
                                          {{1, random.log_uniform(0.05, 1)}, {0, 1}}});
  if (random.chance(0.5))
    c.prefilter = {{1, random.uniform(0, 1)},
                   {{1, random.log_uniform(0.1, 2)}, {1, 0.8, random.log_uniform(0.1, 2)}}};
  return c;
}

/// With a dead time of 1, or without; the plant is negative as often as not, and its controller with it.
inline GeneralLoop random_general_loop(Random& random, double dead_time) {
  for (;;) {
    GeneralLoop loop{{random_plant(random), dead_time}, random_controller(random)};
    if (random.chance(0.3))
      for (Polynomial* p :
           {&loop.plant.rational.numerator, &loop.controller.on_output, &loop.controller.on_setpoint})
        *p = scaled(-1, *p);
    if (!why_invalid(loop)) return loop;
  }
}

}  // namespace portrait::oracle
