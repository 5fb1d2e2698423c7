#include "engine/loop/stability.h"

#include <cmath>
#include <numbers>

#include "engine/base/check.h"

namespace portrait {

int unstable_roots(const OpenLoop& loop) {
  PORTRAIT_CHECK(high_frequency_gain(loop) < 1);
  bool above = low_frequency_gain(loop) > 1;
  int turns = 0;
  for (const double omega : gain_crossovers(loop)) {
    const int turn = static_cast<int>(std::lround(phase_at(loop, omega) / (2 * std::numbers::pi)));
    turns += above ? turn : -turn;
    above = !above;
  }
  PORTRAIT_CHECK(!above);
  return -2 * turns;
}

bool is_stable(const OpenLoop& loop) { return high_frequency_gain(loop) < 1 && unstable_roots(loop) == 0; }

}  // namespace portrait
