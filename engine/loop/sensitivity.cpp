#include "engine/loop/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "engine/base/check.h"

namespace portrait {
namespace {

enum class Function { sensitivity, complementary };

/// Frequencies a <= omega <= b, 0 <= a < b <= inf, on which the function is nowhere above `bound`.
struct Interval {
  double a, b, bound;
  bool operator<(const Interval& other) const { return bound < other.bound; }
};

/// Bounds of a function's magnitude and of its first two derivatives over an interval.
struct Bounds {
  double zeroth, first, second;
};

Bounds product(const Bounds& f, const Bounds& g) {
  return {f.zeroth * g.zeroth, f.first * g.zeroth + f.zeroth * g.first,
          f.second * g.zeroth + 2 * f.first * g.first + f.zeroth * g.second};
}

/// 1/f, with |f| >= least.
Bounds reciprocal(const Bounds& f, double least) {
  const double rate = f.first / least;
  return {1 / least, rate / least, (f.second / least + 2 * rate * rate) / least};
}

/// N(jw), a <= w <= b.
Bounds numerator_bounds(const OpenLoop& loop, double a, double b) {
  const auto& [n0, n1, n2] = loop.numerator;
  const double real = std::max(std::abs(n0 - n2 * a * a), std::abs(n0 - n2 * b * b));
  return {std::hypot(real, n1 * b), std::hypot(n1, 2 * n2 * b), 2 * n2};
}

/// D(jw): every factor's magnitude grows with w, and its slope is constant.
Bounds denominator_bounds(const OpenLoop& loop, double b) {
  Bounds D{1, 0, 0};
  for (int i = 0; i < loop.integrators; ++i) D = product(D, {b, 1, 0});
  for (const double T : loop.lags) D = product(D, {std::hypot(1, T * b), T, 0});
  return D;
}

double least_denominator(const OpenLoop& loop, double a) {
  double least = std::pow(a, loop.integrators);
  for (const double T : loop.lags) least *= std::hypot(1, T * a);
  return least;
}

double least_numerator(const OpenLoop& loop, double a, double b, double steepest) {
  const auto& [n0, n1, n2] = loop.numerator;
  const double middle = 0.5 * (a + b);
  return std::hypot(n0 - n2 * middle * middle, n1 * middle) - steepest * 0.5 * (b - a);
}

/// e^{jw} and e^{-jw}
constexpr Bounds kTurn{1, 1, 1};

class PeakSearch {
 public:
  PeakSearch(const OpenLoop& loop, Function function)
      : loop_(loop), function_(function), extremes_(gain_extremes(loop)), best_(limit_at_zero()) {
    offer(limit_at_infinity());
  }

  /// The interval that promises most is cut first, until none promises more than was found.
  Peak find() {
    add(0, 1);
    add(1, kInf);
    while (!open_.empty() && promises_more(open_.top().bound)) {
      const auto [a, b, bound] = open_.top();
      open_.pop();
      const double cut = a == 0 ? 0.25 * b : b == kInf ? 4 * a : b > 4 * a ? std::sqrt(a * b) : 0.5 * (a + b);
      if (cut <= a || cut >= b) continue;  // neighbouring numbers: nothing lies between
      add(a, cut);
      add(cut, b);
    }
    refine();
    return best_;
  }

 private:
  void add(double a, double b) {
    const double bound = b == kInf ? bound_beyond(a) : bound_by_taylor(a, b);
    if (promises_more(bound)) open_.push({a, b, bound});
  }

  bool promises_more(double bound) const { return bound > best_.value * (1 + kTolerance); }

  void offer(const Peak& peak) {
    if (peak.value > best_.value) best_ = peak;
  }

  /// The search ends when no value promises more, which leaves the place of a flat peak open: there the slope is 0.
  void refine() {
    if (best_.omega == 0 || best_.omega == kInf) return;
    const bool right = slope(best_.omega) > 0;
    double before = best_.omega, beyond = before, step = 1e-9;
    do {
      before = std::exchange(beyond, right ? beyond * (1 + step) : beyond / (1 + step));
      step *= 2;
    } while (step < 1 && (slope(beyond) > 0) == right);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (before + beyond);
      ((slope(middle) > 0) == right ? before : beyond) = middle;
    }
    const double found = value(before);
    if (found >= best_.value * (1 - kTolerance)) best_ = {std::max(found, best_.value), before};
  }

  double value(double omega) const {
    const std::complex<double> L = response_at(loop_, omega);
    return (function_ == Function::sensitivity ? 1 : std::abs(L)) / std::abs(1.0 + L);
  }

  /// Of log |S| or log |T|.
  double slope(double omega) const {
    const std::complex<double> L = response_at(loop_, omega), rate = log_slope_at(loop_, omega);
    return (function_ == Function::sensitivity ? -rate * L / (1.0 + L) : rate / (1.0 + L)).real();
  }

  /// Over all omega >= a, from |1 + L| >= 1 - |L|.
  double bound_beyond(double a) const {
    double gain = std::max(gain_at(loop_, a), high_frequency_gain(loop_));
    for (const double omega : extremes_)
      if (omega > a) gain = std::max(gain, gain_at(loop_, omega));
    return gain < 1 ? power(gain) / (1 - gain) : kInf;
  }

  /// S = 1/(1 + L) = M/(1 + M) and T = L/(1 + L) = 1/(1 + M), M = 1/L: with X the smaller one of L and M, both
  /// have the slopes F' = -+X'/(1 + X)^2, F'' = -+X''/(1 + X)^2 +- 2 X'^2/(1 + X)^3, and
  /// |F(m + x)| <= |F(m) + F'(m) x| + max|F''| x^2/2 about the middle m.
  double bound_by_taylor(double a, double b) {
    const double middle = 0.5 * (a + b), reach = 0.5 * (b - a);
    const std::complex<double> L = response_at(loop_, middle);
    const bool small = std::abs(L) < 1;
    const std::complex<double> X = small ? L : 1.0 / L, near = 1.0 + X;
    const bool one_over = small == (function_ == Function::sensitivity);
    const std::complex<double> F = (one_over ? 1.0 : X) / near;
    offer({std::abs(F), middle});

    const Bounds most = small ? gain_bounds(a, b) : inverse_gain_bounds(a, b);
    const double nearest = std::max(std::abs(near) - most.first * reach, 1 - most.zeroth);
    if (!(nearest > 0)) return kInf;
    const std::complex<double> step = reach * log_slope_at(loop_, middle) * X / (near * near);
    const double curved = (most.second + 2 * most.first * most.first / nearest) / (nearest * nearest);
    const double fine = std::max(std::abs(F + step), std::abs(F - step)) + 0.5 * curved * reach * reach;
    return std::min((one_over ? 1 : most.zeroth) / nearest, fine);
  }

  Bounds gain_bounds(double a, double b) const {
    const Bounds one_over_D = reciprocal(denominator_bounds(loop_, b), least_denominator(loop_, a));
    return product(product(numerator_bounds(loop_, a, b), kTurn), one_over_D);
  }

  Bounds inverse_gain_bounds(double a, double b) const {
    const Bounds N = numerator_bounds(loop_, a, b);
    const double least = least_numerator(loop_, a, b, N.first);
    if (!(least > 0)) return {kInf, kInf, kInf};
    return product(product(denominator_bounds(loop_, b), kTurn), reciprocal(N, least));
  }

  double power(double gain) const { return function_ == Function::sensitivity ? 1 : gain; }

  Peak limit_at_zero() const {
    const double gain = low_frequency_gain(loop_);
    if (function_ == Function::sensitivity) return {1 / (1 + gain), 0};
    return {std::isinf(gain) ? 1 : gain / (1 + gain), 0};
  }

  Peak limit_at_infinity() const {
    const double gain = high_frequency_gain(loop_);
    return {power(gain) / (1 - gain), kInf};
  }

  static constexpr double kTolerance = 2e-11;

  const OpenLoop& loop_;
  Function function_;
  std::vector<double> extremes_;
  Peak best_;
  std::priority_queue<Interval> open_;
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
