#include "engine/loop/phase_crossovers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace portrait {
namespace {

using std::numbers::pi;

/// The odd multiple of pi next to `phase` on the way down or up, `phase` itself included.
double odd_multiple_next_to(double phase, bool down) {
  const double turns = (phase / pi - 1) / 2;
  return pi * (2 * (down ? std::floor(turns) : std::ceil(turns)) + 1);
}

/// Somewhere beyond `from` where the phase, monotonic from there on, is past `target`.
double beyond(const OpenLoop& loop, double from, double target, bool down) {
  double omega = 2 * from + 1;
  while (std::isfinite(omega) && (phase_at(loop, omega) > target) == down) omega *= 2;
  return omega;
}

/// Where the phase, monotonic between, takes the value `target`.
double omega_of_phase(const OpenLoop& loop, double target, double a, double b) {
  const bool falls = phase_at(loop, a) > phase_at(loop, b);
  double omega = 0.5 * (a + b);
  for (int i = 0; i < 200; ++i) {
    const double off = phase_at(loop, omega) - target;
    ((off > 0) == falls ? a : b) = omega;
    double next = omega - off / log_slope_at(loop, omega).imag();
    if (!(next > std::min(a, b) && next < std::max(a, b))) next = 0.5 * (a + b);
    if (std::abs(next - omega) <= 2e-16 * omega) return next;
    omega = next;
  }
  return omega;
}

}  // namespace

std::optional<double> nearest_phase_crossover(const OpenLoop& loop, double from, double to) {
  const double at_from = phase_at(loop, from), at_to = to == kInf ? high_frequency_phase(loop) : phase_at(loop, to);
  const bool down = at_to < at_from;
  const double target = odd_multiple_next_to(at_from, down);
  if (down ? target < at_to : target > at_to) return std::nullopt;
  if ((to == 0 || to == kInf) && target == at_to) return std::nullopt;  // a limit that is only tended to
  if (to != kInf) return omega_of_phase(loop, target, from, to);
  const double far = beyond(loop, from, target, down);
  if (!std::isfinite(far)) return std::nullopt;  // the limit, but for rounding
  return omega_of_phase(loop, target, from, far);
}

std::vector<double> phase_crossovers(const OpenLoop& loop, double highest) {
  std::vector<double> ends = phase_extremes(loop), found;
  ends.erase(std::upper_bound(ends.begin(), ends.end(), highest), ends.end());
  ends.push_back(highest);
  double a = 0;
  for (const double b : ends) {
    const double at_a = phase_at(loop, a), at_b = phase_at(loop, b);
    const bool down = at_b < at_a;
    const double turn = down ? -2 * pi : 2 * pi;
    double target = odd_multiple_next_to(at_a, down);
    if (target == at_a) target += turn;  // begun with, or found already
    for (; down ? target >= at_b : target <= at_b; target += turn)
      found.push_back(omega_of_phase(loop, target, a, b));
    a = b;
  }
  return found;
}

}  // namespace portrait
