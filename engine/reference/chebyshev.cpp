#include "engine/reference/chebyshev.h"

#include <cmath>
#include <numbers>

namespace portrait::reference {
namespace {

/// Chebyshev points of the second kind on [-1, 1] and the matrix from values there to coefficients.
struct Points {
  Eigen::VectorXd at;
  Eigen::MatrixXd to_coefficients;
};

Points points_for(Eigen::Index size) {
  Points points{Eigen::VectorXd(size), Eigen::MatrixXd(size, size)};
  const double n = static_cast<double>(size - 1);
  for (Eigen::Index j = 0; j < size; ++j) points.at(j) = std::cos(std::numbers::pi * static_cast<double>(j) / n);
  for (Eigen::Index k = 0; k < size; ++k)
    for (Eigen::Index j = 0; j < size; ++j) {
      const double ends = (k == 0 || k == size - 1 ? 0.5 : 1) * (j == 0 || j == size - 1 ? 0.5 : 1);
      points.to_coefficients(k, j) =
          2 / n * ends * std::cos(std::numbers::pi * static_cast<double>(j) * static_cast<double>(k) / n);
    }
  return points;
}

double rest(const Series& c) { return bound(c) - std::abs(c(0)); }

bool has_no_zero(const Series& c) { return std::abs(c(0)) > rest(c); }

/// A point where f leaves the sign it has at x = -1. REQUIRES: it has the other sign at x = 1.
double crossing(const Series& c, bool starts_negative) {
  double left = -1, right = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (left + right);
    ((value(c, middle) < 0) == starts_negative ? left : right) = middle;
  }
  return 0.5 * (left + right);
}

/// A stretch [from, to] of the panel, and the signs at its ends. They are handed down, so that two
/// neighbouring stretches never disagree on the point between them, where f may be nothing but rounding.
struct Stretch {
  double from, to;
  bool starts_negative, ends_negative;
};

void collect_sign_changes(const Series& c, const Stretch& at, double noise, int halvings_left,
                          std::vector<double>& found) {
  const double middle = 0.5 * (at.from + at.to), half = 0.5 * (at.to - at.from);
  if (has_no_zero(c) || bound(c) <= noise || halvings_left == 0 || has_no_zero(derivative(c))) {
    if (at.starts_negative != at.ends_negative) found.push_back(middle + half * crossing(c, at.starts_negative));
    return;
  }
  const double here = value(c, 0);
  const bool negative = std::abs(here) <= noise ? at.starts_negative : here < 0;
  collect_sign_changes(restricted(c, -1, 0), {at.from, middle, at.starts_negative, negative}, noise,
                       halvings_left - 1, found);
  collect_sign_changes(restricted(c, 0, 1), {middle, at.to, negative, at.ends_negative}, noise, halvings_left - 1,
                       found);
}

constexpr int kHalvings = 20;

}  // namespace

double value(const Series& c, double x) {
  double b1 = 0, b2 = 0;
  for (Eigen::Index k = c.size() - 1; k >= 1; --k) {
    const double b0 = c(k) + 2 * x * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return c(0) + x * b1 - b2;
}

Series derivative(const Series& c) {
  const Eigen::Index n = c.size() - 1;
  if (n < 1) return Series(0);
  Series d = Series::Zero(n);
  for (Eigen::Index k = n; k >= 1; --k) d(k - 1) = 2 * static_cast<double>(k) * c(k) + (k + 1 < n ? d(k + 1) : 0);
  d(0) *= 0.5;
  return d;
}

Series antiderivative(const Series& c) {
  const Eigen::Index n = c.size();
  const auto at = [&](Eigen::Index k) { return k < n ? c(k) : 0.0; };
  Series s = Series::Zero(n + 1);
  s(1) = at(0) - 0.5 * at(2);
  for (Eigen::Index k = 2; k <= n; ++k) s(k) = (at(k - 1) - at(k + 1)) / (2 * static_cast<double>(k));
  s(0) = -value(s, -1);
  return s;
}

/// T_i T_j = (T_{i+j} + T_{|i-j|})/2
Series product(const Series& f, const Series& g) {
  Series p = Series::Zero(f.size() + g.size() - 1);
  for (Eigen::Index i = 0; i < f.size(); ++i)
    for (Eigen::Index j = 0; j < g.size(); ++j) {
      const double half = 0.5 * f(i) * g(j);
      p(i + j) += half;
      p(std::abs(i - j)) += half;
    }
  return p;
}

Series restricted(const Series& c, double from, double to) {
  if (c.size() == 1) return c;
  thread_local Points points;
  if (points.at.size() != c.size()) points = points_for(c.size());
  Eigen::VectorXd values(c.size());
  for (Eigen::Index j = 0; j < c.size(); ++j)
    values(j) = value(c, 0.5 * ((to + from) + (to - from) * points.at(j)));
  return points.to_coefficients * values;
}

std::vector<double> sign_changes(const Series& c, double noise) {
  std::vector<double> found;
  if (c.size() < 2 || bound(c) <= noise) return found;
  collect_sign_changes(c, {-1, 1, value(c, -1) < 0, value(c, 1) < 0}, noise, kHalvings, found);
  return found;
}

double bound(const Series& c) { return c.cwiseAbs().sum(); }

}  // namespace portrait::reference
