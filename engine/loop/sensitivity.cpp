#include "engine/loop/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"

namespace portrait {
namespace {

enum class Function { sensitivity, complementary };

struct Interval {
  double a, b;  ///< 0 <= a < b <= inf
};

struct Range {
  double low, high;
};

class PeakSearch {
 public:
  PeakSearch(const OpenLoop& loop, Function function)
      : loop_(loop), function_(function), extremes_(gain_extremes(loop)), best_(limit_at_zero()) {
    offer(limit_at_infinity());
  }

  Peak find() {
    std::vector<Interval> open{{0, 1}, {1, kInf}};
    while (!open.empty()) {
      const Interval interval = open.back();
      open.pop_back();
      examine(interval, open);
    }
    return best_;
  }

 private:
  void examine(const Interval& interval, std::vector<Interval>& open) {
    const Range gain = gain_range(interval);
    if (bound_by_gain(gain) <= best_.value * kSlack) return;
    if (interval.a == 0 || interval.b > 2 * interval.a) return split(interval, open);
    const double middle = 0.5 * (interval.a + interval.b);
    const double distance = std::abs(1.0 + response_at(loop_, middle));
    const double change = lipschitz(interval, gain) * 0.5 * (interval.b - interval.a);
    if (change > 0.25 * distance) return split(interval, open);
    const double bound = power(gain.high) / (distance - change);
    if (bound <= best_.value * kSlack) return;
    refine(interval);
  }

  static void split(const Interval& interval, std::vector<Interval>& open) {
    const auto [a, b] = interval;
    const double cut = a == 0 ? 0.25 * b : b == kInf ? 4 * a : b > 4 * a ? std::sqrt(a * b) : 0.5 * (a + b);
    if (a == 0 && cut < kLowest) return;
    open.push_back({cut, b});
    open.push_back({a, cut});
  }

  /// The function has at most one peak in an interval in which 1 + L turns so little.
  void refine(Interval interval) {
    offer({at(interval.a), interval.a});
    offer({at(interval.b), interval.b});
    if (slope(interval.a) <= 0 || slope(interval.b) >= 0) return;
    for (int i = 0; i < 60 && interval.b > interval.a; ++i) {
      const double middle = 0.5 * (interval.a + interval.b);
      (slope(middle) > 0 ? interval.a : interval.b) = middle;
    }
    offer({at(interval.a), interval.a});
  }

  double at(double omega) const {
    const std::complex<double> L = response_at(loop_, omega);
    return power(std::abs(L)) / std::abs(1.0 + L);
  }

  /// Sign of d/dw log of the function: d/dw log L = l gives Re(-l L/(1 + L)) and Re(l/(1 + L)).
  double slope(double omega) const {
    const std::complex<double> L = response_at(loop_, omega), l = log_slope_at(loop_, omega);
    return function_ == Function::sensitivity ? -(l * L / (1.0 + L)).real() : (l / (1.0 + L)).real();
  }

  double power(double gain) const { return function_ == Function::sensitivity ? 1 : gain; }

  /// The function's largest value while |L| stays within a range that does not hold 1.
  double bound_by_gain(const Range& gain) const {
    if (gain.high < 1) return power(gain.high) / (1 - gain.high);
    if (gain.low <= 1) return kInf;
    return function_ == Function::sensitivity ? 1 / (gain.low - 1) : 1 / (1 - 1 / gain.low);
  }

  Range gain_range(const Interval& interval) const {
    const double left = interval.a == 0 ? low_frequency_gain(loop_) : gain_at(loop_, interval.a);
    const double right = interval.b == kInf ? high_frequency_gain(loop_) : gain_at(loop_, interval.b);
    Range range{std::min(left, right), std::max(left, right)};
    for (const double omega : extremes_) {
      if (omega <= interval.a || omega >= interval.b) continue;
      const double gain = gain_at(loop_, omega);
      range = {std::min(range.low, gain), std::max(range.high, gain)};
    }
    return range;
  }

  /// Bound of |dL/dw| = |N' - N (D'/D + 1)| / |D| over the interval: |D| grows and |D'/D| falls with w.
  double lipschitz(const Interval& interval, const Range& gain) const {
    const auto& [n0, n1, n2] = loop_.numerator;
    double denominator = std::pow(interval.a, loop_.integrators);
    double rate = 1 + loop_.integrators / interval.a;
    for (const double T : loop_.lags) {
      denominator *= std::hypot(1, T * interval.a);
      rate += T / std::hypot(1, T * interval.a);
    }
    return std::hypot(n1, 2 * n2 * interval.b) / denominator + gain.high * rate;
  }

  Peak limit_at_zero() const {
    const double gain = low_frequency_gain(loop_);
    if (function_ == Function::sensitivity) return {1 / (1 + gain), 0};
    return {std::isinf(gain) ? 1 : gain / (1 + gain), 0};
  }

  Peak limit_at_infinity() const {
    const double gain = high_frequency_gain(loop_);
    return {power(gain) / (1 - gain), kInf};
  }

  void offer(const Peak& peak) {
    if (peak.value > best_.value) best_ = peak;
  }

  static constexpr double kSlack = 1 + 1e-12;
  static constexpr double kLowest =
      1e-30;  ///< lower frequencies differ from the limit w -> 0 by less than rounding

  const OpenLoop& loop_;
  Function function_;
  std::vector<double> extremes_;
  Peak best_;
};

}  // namespace

Peak sensitivity_peak(const OpenLoop& loop) {
  PORTRAIT_CHECK(high_frequency_gain(loop) < 1);
  return PeakSearch(loop, Function::sensitivity).find();
}

Peak complementary_sensitivity_peak(const OpenLoop& loop) {
  PORTRAIT_CHECK(high_frequency_gain(loop) < 1);
  return PeakSearch(loop, Function::complementary).find();
}

}  // namespace portrait
