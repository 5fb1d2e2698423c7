/// The kernel's measures against those of the reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/isa/dispatch.h"
#include "engine/kernel/responses.h"
#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "tests/oracle/random_loops.h"

namespace portrait {

inline std::vector<Measure> response_measures() {
  std::vector<Measure> found;
  for (const Measure m : standard_measures())
    if (info(m).step != '-') found.push_back(m);
  return found;
}

inline kernel::Measured measure_one(const kernel::Implementation& implementation, const Loop& loop,
                                    Horizon horizon) {
  kernel::Measured result;
  kernel::measure_responses(implementation, loop.family, {&loop.setting, 1}, horizon, {&result, 1});
  return result;
}

/// |a - b| as a part of b, or of 1e-3 where b is smaller.
inline double error_of(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  return std::abs(a - b) / std::max(1e-3, std::abs(b));
}

/// The total variation of the same signal, of which TV0, TV1, TV2 are differences.
inline double variation_of_signal(const MeasureRow& row, Measure m) {
  const std::string name(to_string(m));
  if (name.rfind("TV", 0) != 0) return 0;
  return row[*measure_named("TV" + name.substr(name.find('_')))];
}

struct Worst {
  double error = 0;
  std::string where = "nowhere";
  void take(double candidate, const Loop& loop, Measure measure) {
    if (candidate <= error) return;
    error = candidate;
    where = std::string(to_string(measure)) + " of " + simulate_command(loop);
  }
};

/// A stable loop with constants in the range of its promise.
inline Loop random_kernel_loop(oracle::Random& random) {
  while (true) {
    const Loop loop = oracle::random_stable_loop(random);
    const bool slow_enough = loop.family.n == 0 || loop.setting.tau_f >= 0.01;
    if (slow_enough) return loop;
  }
}

/// Largest errors over `count` random loops: of the integrals of the error, and of everything else.
struct Errors {
  Worst integral, variation;
  int unresolved = 0, status_differs = 0;
};

inline Errors errors_over(const kernel::Implementation& implementation, int count, std::uint64_t seed) {
  oracle::Random random(seed);
  Errors errors;
  for (int i = 0; i < count; ++i) {
    const Loop loop = random_kernel_loop(random);
    const Horizon horizon = Horizon::fixed(random.chance(0.3) ? random.uniform(5, 40) : 10 + random.below(50));
    const auto fast = measure_one(implementation, loop, horizon);
    const auto slow = reference::measure(loop, horizon);
    errors.unresolved += fast.resolved ? 0 : 1;
    errors.status_differs += fast.status == slow.status ? 0 : 1;
    for (const Measure m : response_measures()) {
      double error = error_of(fast.measures[m], slow.measures[m]);
      const double variation = variation_of_signal(slow.measures, m);
      if (variation > 1e-3) error = std::min(error, std::abs(fast.measures[m] - slow.measures[m]) / variation);
      const bool integral = to_string(m).front() == 'I';
      (integral ? errors.integral : errors.variation).take(error, loop, m);
    }
  }
  return errors;
}

}  // namespace portrait
