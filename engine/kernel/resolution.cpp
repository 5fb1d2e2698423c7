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

/// ln of the last coefficient of e^{-t/T} as one series over a dead time: that of the modified Bessel function
/// I_12(z) e^{-z}, z = 1/(2 T), to a factor of about 2.
double log_of_last_coefficient(double T) {
  const double z = 0.5 / T;
  return std::log(12.5 / z) - 65 / z;
}

/// Dead times until the layers of T have faded. At t = 0 there is none yet, and the first is of full size.
int layered_intervals(const Loop& loop, double T) {
  static const double log_of_faded = std::log(kFaded);
  const double gain_squared = gain_squared_at(loop, 1 / T);
  if (gain_squared >= 0.8) return kAllIntervals;
  const double log_of_excess = log_of_last_coefficient(T) - log_of_faded;
  return rounded_up(2 + std::max(0.0, -2 * log_of_excess / std::log(gain_squared)));
}

/// The first panel of a graded dead time is at most 4 T long.
int grading_for(double T) {
  int exponent = 0;
  std::frexp(4 * T, &exponent);  // 4 T lies in [2^(exponent - 1), 2^exponent)
  return std::clamp(1 - exponent, 0, 20);
}

/// Last coefficients of cos(omega t) as one series of degree 8 over a dead time, as the meters take them: those of the
/// spherical Bessel functions, 17 j_8(z) + 15/8 j_7(z), z = omega/2.
double smooth_tail(double omega) {
  const double z = 0.5 * omega, z2 = z * z, z7 = z2 * z2 * z2 * z;
  return std::min(1.0, z7 * (9.3e-7 + 4.9e-7 * z));
}

/// What |L(j omega)|^2 may be so that the tail there fades below kSmall within each of kIntervalCounts.
struct SmoothLimits {
  static constexpr std::array kOmegas = {0.75, 1.5, 3.0, 8.0};
  static constexpr double kSmall = 5e-10;
  double of[kOmegas.size()][kIntervalCounts.size()];

  SmoothLimits() {
    for (std::size_t i = 0; i < kOmegas.size(); ++i)
      for (std::size_t j = 0; j < kIntervalCounts.size(); ++j)
        of[i][j] = limit(smooth_tail(kOmegas[i]), kIntervalCounts[j]);
  }

  /// The first two dead times see no loop yet; a round takes two.
  static double limit(double tail, int intervals) {
    if (tail <= kSmall) return kInf;
    return intervals == 2 ? 0 : std::min(0.9, std::pow(kSmall / tail, 2.0 / (intervals - 2)));
  }
};

/// Dead times until all parts of a response have faded that a series of the lower degree does not hold.
int smooth_from(const Loop& loop) {
  static const SmoothLimits limits;
  std::size_t count = 0;
  for (std::size_t i = 0; i < limits.kOmegas.size(); ++i) {
    const double gain_squared = gain_squared_at(loop, limits.kOmegas[i]);
    while (count < kIntervalCounts.size() && gain_squared > limits.of[i][count]) ++count;
  }
  return count < kIntervalCounts.size() ? kIntervalCounts[count] : kAllIntervals;
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
