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

/// Least and largest |1 + a jw - b w^2| over an interval: the square is a parabola in w^2.
struct Range {
  double least, most;
};

Range magnitude(const Quadratic& f, double from, double to) {
  const auto at = [&](double x) { return std::hypot(1 - f.b * x, f.a * std::sqrt(x)); };
  const double x0 = from * from, x1 = to * to, at_x0 = at(x0), at_x1 = at(x1);
  const double lowest = f.b == 0 ? -1 : (f.b - 0.5 * f.a * f.a) / (f.b * f.b);
  const double least = lowest > x0 && lowest < x1 ? at(lowest) : std::min(at_x0, at_x1);
  return {least, std::max(at_x0, at_x1)};
}

Bounds factor_bounds(const Quadratic& f, double most, double b) {
  return {most, std::hypot(f.a, 2 * f.b * b), 2 * std::abs(f.b)};
}

/// Product of factors over an interval, or of their inverses.
Bounds product_bounds(const std::vector<Quadratic>& factors, double a, double b) {
  Bounds all{1, 0, 0};
  for (const Quadratic& f : factors) all = product(all, factor_bounds(f, magnitude(f, a, b).most, b));
  return all;
}

Bounds inverse_bounds(const std::vector<Quadratic>& factors, double a, double b) {
  Bounds all{1, 0, 0};
  for (const Quadratic& f : factors) {
    const auto [least, most] = magnitude(f, a, b);
    if (!(least > 0)) return {kInf, kInf, kInf};
    all = product(all, reciprocal(factor_bounds(f, most, b), least));
  }
  return all;
}

/// |w|^power and its slopes, power of any sign.
Bounds power_bounds(int power, double a, double b) {
  const auto at = [&](int p) { return std::pow(p >= 0 ? b : a, p); };
  const double first = std::abs(power), second = std::abs(power * (power - 1));
  return {at(power), first == 0 ? 0 : first * at(power - 1), second == 0 ? 0 : second * at(power - 2)};
}

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

  /// e^{-+jwTd} and c, or 1/c
  Bounds turn_bounds(double gain) const {
    const double Td = loop_.dead_time, c = std::abs(gain);
    return {c, c * Td, c * Td * Td};
  }

  Bounds gain_bounds(double a, double b) const {
    const Bounds N = product(product_bounds(loop_.zeros, a, b), turn_bounds(loop_.gain));
    return product(product(N, power_bounds(-loop_.integrators, a, b)), inverse_bounds(loop_.poles, a, b));
  }

  Bounds inverse_gain_bounds(double a, double b) const {
    const Bounds D = product(product_bounds(loop_.poles, a, b), turn_bounds(1 / loop_.gain));
    return product(product(D, power_bounds(loop_.integrators, a, b)), inverse_bounds(loop_.zeros, a, b));
  }

  double power(double gain) const { return function_ == Function::sensitivity ? 1 : gain; }

  Peak limit_at_zero() const {
    const double gain = low_frequency_gain(loop_);
    if (std::isinf(gain)) return {function_ == Function::sensitivity ? 0.0 : 1.0, 0};
    const double at_rest = loop_.gain < 0 ? -gain : gain;
    return {power(gain) / std::abs(1 + at_rest), 0};
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
