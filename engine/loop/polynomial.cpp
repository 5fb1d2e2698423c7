#include "engine/loop/polynomial.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "engine/base/matrices.h"

namespace portrait {
namespace {

/// Leading zeros say nothing; a zero constant term is a root at 0, which is not positive.
Polynomial stripped(const Polynomial& p) {
  auto first = std::find_if(p.begin(), p.end(), [](double a) { return a != 0; });
  auto last = std::find_if(p.rbegin(), p.rend(), [](double a) { return a != 0; }).base();
  return first < last ? Polynomial(first, last) : Polynomial{};
}

/// Every positive root lies within (lower, upper).                                                  [Cauchy]
struct Bounds {
  double lower, upper;
};

Bounds root_bounds(const Polynomial& p) {
  double low = 0, high = 0;
  for (std::size_t i = 1; i < p.size(); ++i) low = std::max(low, std::abs(p[i]));
  for (std::size_t i = 0; i + 1 < p.size(); ++i) high = std::max(high, std::abs(p[i]));
  const double first = std::abs(p.front());
  return {0.5 * first / (first + low), 2 * (1 + high / std::abs(p.back()))};
}

/// Bisection on a logarithmic scale: roots may lie many decades apart.
double bisected(const Polynomial& p, double left, double right) {
  const bool rising = value(p, left) < 0;
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(left) * std::sqrt(right);
    if (middle <= left || middle >= right) break;
    ((value(p, middle) < 0) == rising ? left : right) = middle;
  }
  return right;
}

}  // namespace

double value(const Polynomial& p, double x) {
  double sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
  return sum;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(static_cast<double>(i) * p[i]);
  return d;
}

Polynomial product(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial r(p.size() + q.size() - 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  return r;
}

Polynomial difference(const Polynomial& p, const Polynomial& q) {
  Polynomial r(std::max(p.size(), q.size()), 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) r[i] += p[i];
  for (std::size_t i = 0; i < q.size(); ++i) r[i] -= q[i];
  return r;
}

Polynomial scaled(double factor, Polynomial p) {
  for (double& a : p) a *= factor;
  return p;
}

Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

int degree(const Polynomial& p) {
  int last = static_cast<int>(p.size()) - 1;
  while (last >= 0 && p[static_cast<std::size_t>(last)] == 0) --last;
  return last;
}

Polynomial in_time_unit(Polynomial p, double unit) {
  double power = 1;
  for (double& a : p) a /= power, power *= unit;
  return p;
}

Division divided(const Polynomial& p, const Polynomial& d) {
  Division by{{}, p};
  if (p.size() < d.size()) return by;
  by.quotient.assign(p.size() - d.size() + 1, 0.0);
  for (std::size_t i = by.quotient.size(); i-- > 0;) {
    const double q = by.rest[i + d.size() - 1] / d.back();
    by.quotient[i] = q;
    for (std::size_t j = 0; j < d.size(); ++j) by.rest[i + j] -= q * d[j];
  }
  by.rest.resize(d.size() - 1);
  return by;
}

std::vector<double> positive_sign_changes(const Polynomial& p_given) {
  const Polynomial p = stripped(p_given);
  if (p.size() < 2) return {};
  const Bounds bounds = root_bounds(p);
  std::vector<double> ends{bounds.lower};
  for (const double stationary : positive_sign_changes(derivative(p)))
    if (stationary > bounds.lower && stationary < bounds.upper) ends.push_back(stationary);
  ends.push_back(bounds.upper);

  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if ((value(p, ends[i]) < 0) != (value(p, ends[i + 1]) < 0)) roots.push_back(bisected(p, ends[i], ends[i + 1]));
  return roots;
}

std::vector<std::complex<double>> complex_roots(const Polynomial& p_given) {
  const Polynomial p = stripped(p_given);
  if (p.size() < 2) return {};
  const auto degree = static_cast<Eigen::Index>(p.size()) - 1;
  // Roots of about size 1 keep the matrix balanced.
  const double size = std::pow(std::abs(p.front() / p.back()), 1.0 / static_cast<double>(degree));
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  for (Eigen::Index i = 0; i < degree; ++i) {
    if (i > 0) companion(i, i - 1) = 1;
    companion(i, degree - 1) =
        -p[static_cast<std::size_t>(i)] / p.back() * std::pow(size, static_cast<double>(i - degree));
  }
  const Eigen::VectorXcd values = eigenvalues(companion);
  std::vector<std::complex<double>> roots;
  for (Eigen::Index i = 0; i < degree; ++i) roots.push_back(size * values(i));
  return roots;
}

}  // namespace portrait
