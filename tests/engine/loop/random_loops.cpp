#include "tests/engine/loop/random_loops.h"

#include <cmath>

#include "engine/loop/stability.h"

namespace portrait {

double RandomLoops::uniform(double from, double to) {
  return from + (to - from) * std::ldexp(static_cast<double>(random_() >> 11), -53);
}

double RandomLoops::log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }

int RandomLoops::index(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

Loop RandomLoops::next() {
  constexpr double kLargestKappa[] = {0.5, 3, 20};
  Loop loop;
  loop.family = {.plant = static_cast<Plant>(index(3)), .n = index(5), .prefilter = Prefilter::none};
  Setting& s = loop.setting;
  s.kappa = log_uniform(1e-3, kLargestKappa[static_cast<std::size_t>(loop.family.plant)]);
  s.tau_i = chance(0.2) ? kInf : log_uniform(0.3, 300);
  s.delta = chance(0.2) ? 0 : log_uniform(1e-3, 3);
  if (loop.family.plant == Plant::fotd) s.tau_1 = log_uniform(1e-2, 100);
  if (loop.family.n > 0) s.tau_f = log_uniform(1e-3, 10);
  return loop;
}

Loop RandomLoops::next_stable() {
  for (;;) {
    const Loop loop = next();
    if (is_stable(open_loop(loop))) return loop;
  }
}

}  // namespace portrait
