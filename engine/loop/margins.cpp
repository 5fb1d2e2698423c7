#include "engine/loop/margins.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/check.h"
#include "engine/loop/phase_crossovers.h"

namespace portrait {
namespace {

using std::numbers::pi;

/// Frequencies a < omega < b, 0 <= a < b <= inf: |L| and arg L are monotonic, and |L| stays on one side of 1.
struct Interval {
  double a, b;
};

std::vector<Interval> monotonic_intervals(const OpenLoop& loop, const std::vector<double>& crossovers) {
  std::vector<double> cuts = crossovers;
  for (const auto& extremes : {gain_extremes(loop), phase_extremes(loop)})
    cuts.insert(cuts.end(), extremes.begin(), extremes.end());
  cuts.push_back(kInf);
  std::sort(cuts.begin(), cuts.end());
  std::vector<Interval> intervals;
  double a = 0;
  for (const double b : cuts) {
    if (b > a) intervals.push_back({a, b});
    a = b;
  }
  return intervals;
}

/// Takes the phase crossover of one interval whose |L| is nearest to 1.
void take_gain_margin(const OpenLoop& loop, const Interval& at, Margins& found) {
  const double inside = at.b == kInf ? 2 * at.a + 1 : 0.5 * (at.a + at.b);
  const bool above = gain_at(loop, inside) > 1;
  const bool falls = gain_at(loop, at.a) > (at.b == kInf ? high_frequency_gain(loop) : gain_at(loop, at.b));
  const bool from_a = above != falls;   // |L| nearest to 1 is at a
  if (!from_a && at.b == kInf) return;  // |L| rises to its limit, which counts itself
  const auto omega = from_a ? nearest_phase_crossover(loop, at.a, at.b) : nearest_phase_crossover(loop, at.b, at.a);
  if (!omega) return;
  const double factor = 1 / gain_at(loop, *omega);
  if (above)
    found.gain_low = std::max(found.gain_low, std::min(factor, 1.0));
  else
    found.gain = std::min(found.gain, std::max(factor, 1.0));
}

/// How far L may turn clockwise before it points to -1, in (0, 2 pi].
double lag_left(const OpenLoop& loop, double omega) {
  const double angle = std::fmod(phase_at(loop, omega) + pi, 2 * pi);
  return angle > 0 ? angle : angle + 2 * pi;
}

}  // namespace

Margins margins(const OpenLoop& loop) {
  PORTRAIT_CHECK(high_frequency_gain(loop) < 1);
  const std::vector<double> crossovers = gain_crossovers(loop);
  const PhaseMargins turn = phase_margins(loop, crossovers);
  Margins found{1 / high_frequency_gain(loop), 0, turn.phase_deg, turn.delay};
  for (const Interval& interval : monotonic_intervals(loop, crossovers)) take_gain_margin(loop, interval, found);
  return found;
}

PhaseMargins phase_margins(const OpenLoop& loop, const std::vector<double>& crossovers) {
  PhaseMargins found{kInf, kInf};
  for (const double omega : crossovers) {
    const double lag = lag_left(loop, omega);
    found.phase_deg = std::min(found.phase_deg, std::min(lag, 2 * pi - lag) * 180 / pi);
    found.delay = std::min(found.delay, lag / omega);
  }
  return found;
}

}  // namespace portrait
