#include "engine/loop/stability.h"

#include <cmath>
#include <numbers>

#include "engine/base/check.h"

namespace portrait {

int unstable_roots(const OpenLoop& loop) { return unstable_roots(loop, gain_crossovers(loop)); }

int unstable_roots(const OpenLoop& loop, const std::vector<double>& crossovers) {
  PORTRAIT_CHECK(high_frequency_gain(loop) < 1);
  // |L| ends below 1: seen from the highest crossover down, it falls and rises by turns.
  bool falls = true;
  double turns = 0;  // whole; more of them than an int holds where a delay lies far beyond a crossover's period
  for (auto omega = crossovers.rbegin(); omega != crossovers.rend(); ++omega) {
    const double turn = std::round(phase_at(loop, *omega) / (2 * std::numbers::pi));
    turns += falls ? turn : -turn;
    falls = !falls;
  }
  const double at_rest = low_frequency_gain(loop);
  PORTRAIT_CHECK(at_rest == 1 || falls == (at_rest < 1));
  const int of_sign = loop.gain < 0 && at_rest > 1 ? 1 : 0;
  const double roots = unstable_poles(loop) - of_sign - 2 * turns;
  return roots < kMostRoots ? static_cast<int>(roots) : kMostRoots;
}

bool is_stable(const OpenLoop& loop) { return is_stable(loop, gain_crossovers(loop)); }

bool is_stable(const OpenLoop& loop, const std::vector<double>& crossovers) {
  // L = -1 at rest is a root at 0.
  if (loop.gain < 0 && low_frequency_gain(loop) == 1) return false;
  return high_frequency_gain(loop) < 1 && unstable_roots(loop, crossovers) == 0;
}

}  // namespace portrait
