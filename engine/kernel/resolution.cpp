#include "engine/kernel/resolution.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/loop/open_loop.h"

namespace portrait::kernel {
namespace {

/// Layers this small, as a part of the signal, no longer matter.
constexpr double kFaded = 1e-9;
constexpr int kAllIntervals = 1 << 30;
/// Few different numbers, so that many settings share one.
constexpr std::array kIntervalCounts = {2, 3, 4, 5, 6, 8, 10, 12, 16, 24, 32, 48, 64};

int rounded_up(double intervals) {
  for (const int count : kIntervalCounts)
    if (intervals <= count) return count;
  return kAllIntervals;
}

/// Last coefficient of e^{-t/T} as one series over a dead time: that of the modified Bessel function I_12(z) e^{-z},
/// z = 1/(2 T), to a factor of about 2.
double last_coefficient(double T) {
  const double z = 0.5 / T;
  return 12.5 / z * std::exp(-65 / z);
}

/// Dead times until the layers of T have faded. At t = 0 there is none yet, and the first is of full size.
int layered_intervals(const Loop& loop, double T) {
  const double gain_squared = gain_squared_at(loop, 1 / T);
  if (gain_squared >= 0.8) return kAllIntervals;
  return rounded_up(2 + std::max(0.0, 2 * std::log(kFaded / last_coefficient(T)) / std::log(gain_squared)));
}

/// The first panel of a graded dead time is at most 4 T long.
int grading_for(double T) { return static_cast<int>(std::clamp(std::ceil(-std::log2(4 * T)), 0.0, 20.0)); }

/// Last coefficients of cos(omega t) as one series of degree 8 over a dead time, as the meters take them: those of the
/// spherical Bessel functions, 17 j_8(z) + 15/8 j_7(z), z = omega/2.
double smooth_tail(double omega) {
  const double z = 0.5 * omega, z2 = z * z, z7 = z2 * z2 * z2 * z;
  return std::min(1.0, z7 * (9.3e-7 + 4.9e-7 * z));
}

/// Dead times until all parts of a response have faded that a series of the lower degree does not hold.
int smooth_from(const Loop& loop) {
  constexpr double kSmall = 5e-10;
  double intervals = 0;
  for (const double omega : {0.75, 1.5, 3.0, 8.0}) {
    const double tail = smooth_tail(omega);
    if (tail <= kSmall) continue;
    const double gain_squared = gain_squared_at(loop, omega);
    if (gain_squared >= 0.9) return kAllIntervals;
    intervals = std::max(intervals, 2 * std::log(kSmall / tail) / std::log(gain_squared));
  }
  return rounded_up(2 + intervals);
}

}  // namespace

Resolution first_resolution(const Loop& loop, double fastest) {
  Resolution first;
  first.mesh.graded = fastest < kInf ? grading_for(fastest) : 0;
  if (first.mesh.graded > 0) first.layered_intervals = layered_intervals(loop, fastest);
  first.smooth_from = std::max(smooth_from(loop), first.layered_intervals);
  return first;
}

std::optional<Resolution> finer(const Resolution& last) {
  Resolution next = last;
  ++next.attempt;
  const bool layers_go_on = last.layered_intervals == kAllIntervals || last.mesh.graded == 0;
  if (next.attempt == 1 && !layers_go_on) {
    next.layered_intervals = 2 * last.layered_intervals + 2;
    next.smooth_from = std::max(last.smooth_from, next.layered_intervals);
    ++next.mesh.graded;
    return next;
  }
  next.layered_intervals = next.smooth_from = kAllIntervals;
  ++next.mesh.halved;
  if (panels_of(next.mesh) > kMaxPanels) return std::nullopt;
  return next;
}

Resolution without_smooth_part(const Resolution& resolution) {
  Resolution next = resolution;
  next.smooth_from = kAllIntervals;
  return next;
}

}  // namespace portrait::kernel
