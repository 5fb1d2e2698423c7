#include "engine/rules/real_dominant_poles.h"

#include <cmath>

#include <Eigen/Core>

#include "engine/base/check.h"
#include "engine/base/matrices.h"

namespace portrait::rules {
namespace {

using Nodes = std::array<double, 4>;

Nodes nodes(PoleSet set, double m, double p_o) {
  Nodes at{};
  for (int i = 0; i < 4; ++i) at[static_cast<std::size_t>(i)] = i < static_cast<int>(set) ? p_o : p_o / m;
  return at;
}

/// g[x0], g[x0,x1], g[x0,x1,x2], g[x0..x3] of g(p) = p^3 e^p: the first row of g of the matrix that has the nodes on its
/// diagonal and ones beside it.
Eigen::RowVector4d divided_differences(const Nodes& x) {
  Eigen::Matrix4d J = Eigen::Matrix4d::Zero();
  for (int i = 0; i < 4; ++i) J(i, i) = x[static_cast<std::size_t>(i)];
  for (int i = 0; i < 3; ++i) J(i, i + 1) = 1;
  return (J * J * J * exponential(J)).row(0);
}

double residual(PoleSet set, double m, double p_o) { return divided_differences(nodes(set, m, p_o))(3); }

/// Halves [right, left] until nothing lies between, the residual being above 0 on the left, towards 0.
double bisected(PoleSet set, double m, double left, double right) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (left + right);
    if (middle >= left || middle <= right) break;
    (residual(set, m, middle) > 0 ? left : right) = middle;
  }
  return 0.5 * (left + right);
}

/// The interpolating quadratic in Newton's form, written out.
RealPolesTuning interpolated(const Nodes& x, double p_o) {
  const Eigen::RowVector4d c = divided_differences(x);
  const double k_i = -(c(0) - c(1) * x[0] + c(2) * x[0] * x[1]);
  const double kappa = -(c(1) - c(2) * (x[0] + x[1]));
  return {.p_o = p_o, .kappa = kappa, .delta = -c(2), .tau_i = kappa / k_i};
}

}  // namespace

std::optional<RealPolesTuning> four_real_poles(PoleSet set, double m) {
  PORTRAIT_CHECK(m > 0 && std::isfinite(m));
  // The third derivative of g vanishes somewhere between the poles, first at -0.4158: no solution is nearer to 0 than
  // that times min(1, m).
  constexpr double kFirst = -0.4157, kStep = 1.01, kFarthest = 1000;
  const double start = kFirst * std::min(1.0, m), end = kFarthest * kFirst * std::max(1.0, m);
  for (double left = start; left > end; left *= kStep)
    if (residual(set, m, left * kStep) <= 0) {
      const double p_o = bisected(set, m, left, left * kStep);
      return interpolated(nodes(set, m, p_o), p_o);
    }
  return std::nullopt;
}

RealPolesTuning triple_real_pole() {
  const double p = std::sqrt(2.0) - 2, e = std::exp(p);
  return {.p_o = p, .kappa = p * p * (1 + p) * e, .delta = -p * (2 + p) * e, .tau_i = kInf};
}

std::array<double, 4> quasi_polynomial(const RealPolesTuning& t, double p) {
  const double e = std::exp(p), k_i = t.kappa / t.tau_i;
  return {p * p * p * e + k_i + t.kappa * p + t.delta * p * p, ((p + 3) * p * p) * e + t.kappa + 2 * t.delta * p,
          (((p + 6) * p + 6) * p) * e + 2 * t.delta, (((p + 9) * p + 18) * p + 6) * e};
}

}  // namespace portrait::rules
