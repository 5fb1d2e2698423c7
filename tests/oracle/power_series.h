/// A signal in pieces, each a power series of the time since the piece began, and the measures of such a signal.
///
///     f(start + x) = c_0 + c_1 x + c_2 x^2 + ...,   0 <= x <= length
///
/// Written to judge the measures of the reference simulation: long double, no code of engine/. Sign changes are looked
/// for on a fine raster and then closed in on, so a pair closer than the raster (1/256 of a piece) is missed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace portrait::oracle {

using Real = long double;
using PowerSeries = std::vector<Real>;  ///< c_0, c_1, ...

struct PowerPiece {
  Real start, length;
  PowerSeries c;
};
using Signal = std::vector<PowerPiece>;

/// Even and odd terms by themselves, which do not wait for each other; not inlined, as amid other code gcc keeps sums in memory.
[[gnu::noinline]] inline Real value(const PowerSeries& c, Real x) {
  const Real squared = x * x;
  std::size_t k = c.size();
  Real even = k % 2 == 1 ? c[--k] : 0, odd = 0;
  while (k > 0) {
    odd = odd * squared + c[--k];
    even = even * squared + c[--k];
  }
  return even + x * odd;
}

inline PowerSeries derivative(const PowerSeries& c) {
  PowerSeries d;
  for (std::size_t k = 1; k < c.size(); ++k) d.push_back(static_cast<Real>(k) * c[k]);
  return d;
}

/// 0 at x = 0.
inline PowerSeries antiderivative(const PowerSeries& c) {
  PowerSeries s{0};
  for (std::size_t k = 0; k < c.size(); ++k) s.push_back(c[k] / static_cast<Real>(k + 1));
  return s;
}

/// Without the last terms, as far as all of them together are below a hundredth of the rounding of f's largest term.
inline PowerSeries trimmed(const PowerSeries& c, Real length) {
  constexpr Real kBelow = std::numeric_limits<Real>::epsilon() / 100;
  std::vector<Real> terms;
  Real power = 1, largest = 0, rest = 0;
  for (const Real of : c)
    terms.push_back(std::abs(of) * power), largest = std::max(largest, terms.back()), power *= length;
  std::size_t left = c.size();
  while (left > 1 && (rest += terms[left - 1]) <= kBelow * largest) --left;
  return {c.begin(), c.begin() + static_cast<std::ptrdiff_t>(left)};
}

/// Whether c_0 outweighs all other terms on 0 <= x <= length: then f has no zero there.
inline bool has_no_zero(const PowerSeries& c, Real length) {
  Real rest = 0;
  for (std::size_t k = c.size() - 1; k > 0; --k) rest = (rest + std::abs(c[k])) * length;
  return std::abs(c[0]) > rest;
}

/// sum k |c_k| length^(k - 1)
inline Real steepest(const PowerSeries& c, Real length) {
  Real sum = 0;
  for (std::size_t k = c.size(); k-- > 1;) sum = sum * length + static_cast<Real>(k) * std::abs(c[k]);
  return sum;
}

/// Where f, of different sign at both ends, is 0: false position, the value at an end that stays halved each time (Illinois), and
/// where that is slow, at a zero of higher order, halving.
template <typename Function>
Real zero_between(const Function& f, Real left, Real right, Real of_left, Real of_right) {
  const Real fine = std::numeric_limits<Real>::epsilon() * std::max(right - left, std::abs(left));
  const bool negative = of_left < 0;
  int last = 0;
  for (int k = 0; k < 20; ++k) {
    const Real x = right - of_right * (right - left) / (of_right - of_left), here = f(x);
    const int side = (here < 0) == negative ? -1 : 1;
    const Real moved = side < 0 ? x - left : right - x;
    if (side < 0)
      left = x, of_left = here, of_right = last < 0 ? of_right / 2 : of_right;
    else
      right = x, of_right = here, of_left = last > 0 ? of_left / 2 : of_left;
    if (here == 0 || moved <= fine) return x;
    last = side;
  }
  for (int halving = 0; halving < 70; ++halving) {
    const Real middle = (left + right) / 2;
    ((f(middle) < 0) == negative ? left : right) = middle;
  }
  return left;
}

inline std::vector<Real> sign_changes(const PowerSeries& series, Real length) {
  constexpr int kRaster = 256;
  std::vector<Real> found;
  if (series.empty() || has_no_zero(series, length)) return found;
  const PowerSeries c = trimmed(series, length);
  const Real step = length / kRaster, fall = steepest(c, length) * step;
  Real here = value(c, 0);
  for (int i = 0; i < kRaster;) {
    const Real steps = std::abs(here) / fall;  // f has no zero so near
    const int next = steps < kRaster ? std::min(kRaster, i + std::max(1, static_cast<int>(steps))) : kRaster;
    const Real left = step * i, right = next == kRaster ? length : step * next;
    const Real before = here;
    here = value(c, right);
    i = next;
    if ((here < 0) != (before < 0))
      found.push_back(zero_between([&](Real x) { return value(c, x); }, left, right, before, here));
  }
  return found;
}

/// The signal at one instant; the limit from the right where two pieces meet.
inline Real at(const Signal& signal, Real t) {
  std::size_t i = signal.size() - 1;
  while (i > 0 && signal[i].start > t) --i;
  return value(signal[i].c, t - signal[i].start);
}

inline PowerSeries product(const PowerSeries& f, const PowerSeries& g) {
  PowerSeries p(f.size() + g.size() - 1, 0);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) p[i + j] += f[i] * g[j];
  return p;
}

inline PowerSeries square(const PowerSeries& f) {
  PowerSeries p(2 * f.size() - 1, 0);
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Real twice = 2 * f[i];
    p[2 * i] += f[i] * f[i];
    for (std::size_t j = i + 1; j < f.size(); ++j) p[i + j] += twice * f[j];
  }
  return p;
}

/// Of the error e = target - f over all pieces.
struct ErrorIntegrals {
  Real IAE = 0, ISE = 0, ITAE = 0, ITSE = 0;
};

/// Integral over a piece of f with the sign that e has there, so that f = t e gives the one of t |e|.
inline Real integral_with_sign_of(const PowerSeries& e, const PowerSeries& f, Real length) {
  const PowerSeries integral = antiderivative(f);
  std::vector<Real> ends = sign_changes(e, length);
  ends.push_back(length);
  Real last = 0, sum = 0;
  for (const Real x : ends) {
    sum += std::abs(value(integral, x) - last);
    last = value(integral, x);
  }
  return sum;
}

inline ErrorIntegrals error_integrals(const Signal& signal, Real target) {
  ErrorIntegrals sum;
  for (const PowerPiece& piece : signal) {
    PowerSeries e = piece.c;
    e[0] -= target;
    const PowerSeries t = {piece.start, 1}, squared = square(e);
    sum.IAE += integral_with_sign_of(e, e, piece.length);
    sum.ITAE += integral_with_sign_of(e, product(t, e), piece.length);
    sum.ISE += value(antiderivative(squared), piece.length);
    sum.ITSE += value(antiderivative(product(t, squared)), piece.length);
  }
  return sum;
}

/// The points at which the direction changes, and the two ends.
inline std::vector<Real> without_passed_points(const std::vector<Real>& points) {
  std::vector<Real> turns{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if ((points[i] - turns.back()) * (points[i + 1] - points[i]) < 0) turns.push_back(points[i]);
  turns.push_back(points.back());
  return turns;
}

/// f(0-) = 0, the extremes and the ends of jumps, and the last value.
inline std::vector<Real> turning_points(const Signal& signal) {
  std::vector<Real> points{0};
  for (const PowerPiece& piece : signal) {
    points.push_back(value(piece.c, 0));
    for (const Real x : sign_changes(derivative(piece.c), piece.length)) points.push_back(value(piece.c, x));
    points.push_back(value(piece.c, piece.length));
  }
  return without_passed_points(points);
}

inline Real variation(const std::vector<Real>& points) {
  Real sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += std::abs(points[i] - points[i - 1]);
  return sum;
}

/// TVm for m <= 2 by trying every shape: 0, at most m of the points alternately on both sides of `rest`, `rest`.
inline Real shape_deviation(const std::vector<Real>& points, Real rest, int m) {
  Real best = std::abs(rest);
  for (std::size_t i = 1; m >= 1 && i < points.size(); ++i) {
    const Real first = std::abs(points[i]);
    best = std::max(best, first + std::abs(rest - points[i]));
    for (std::size_t j = i + 1; m >= 2 && j < points.size(); ++j)
      if ((points[i] > rest) != (points[j] > rest))
        best = std::max(best, first + std::abs(points[j] - points[i]) + std::abs(rest - points[j]));
  }
  return variation(points) + std::abs(rest - points.back()) - best;
}

}  // namespace portrait::oracle
