#include "engine/rules/magnitude_optimum.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "engine/base/check.h"

namespace portrait::rules {
namespace {

/// Row r: the coefficient of w^{2r} in Re L, alternating signs over the gains.                            [HO-PID (15)]
Eigen::MatrixXd conditions(const Areas& A, int m) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(m + 2, m + 2);
  for (int r = 0; r < m + 2; ++r)
    for (int c = 0; c < m + 2 && c <= 2 * r + 1; ++c)
      M(r, c) = (c % 2 == 0 ? -1 : 1) * A[static_cast<std::size_t>(2 * r + 1 - c)];
  return M;
}

/// Time constant by time constant: A_i grows like T^i, which is no fault of the system's condition.
double time_scale(const Areas& A) { return A[0] != 0 && A[1] != 0 ? std::abs(A[1] / A[0]) : 1; }

double filter_constant(double K_m, int m, int n, double K_HF, double Ts) {
  const double ratio = std::abs(K_m / K_HF);
  if (n == m) return std::pow(ratio, 1.0 / m);
  const double bracket = 1.0 / (2 * m + 1) + 1.0 / (2 * (n - m) - 1), w_S = 2 * std::numbers::pi / Ts;
  return std::pow(ratio * ratio * bracket / w_S, 1.0 / (2 * m + 1));
}

}  // namespace

std::optional<std::vector<double>> magnitude_optimum(const Areas& with_filter, int m) {
  PORTRAIT_CHECK(m >= 0 && with_filter.size() >= areas_for_order(m));
  constexpr double kSmallestPivot = 1e-13;  // of the largest: below it the gains have no digits left
  const double T = time_scale(with_filter);
  Areas scaled = with_filter;
  for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] /= std::pow(T, static_cast<double>(i));
  Eigen::VectorXd right = Eigen::VectorXd::Zero(m + 2);
  right(0) = -0.5;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(conditions(scaled, m));
  lu.setThreshold(kSmallestPivot);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::VectorXd K = lu.solve(right);
  std::vector<double> gains;
  for (int c = 0; c < m + 2; ++c) gains.push_back(K(c) * std::pow(T, c - 1));
  return gains;
}

std::optional<NoiseGainDesign> magnitude_optimum_for_noise_gain(const Areas& plant, int m, int n, double K_HF,
                                                                double Ts) {
  PORTRAIT_CHECK(n >= m && n >= 1);
  constexpr int kMostTurns = 500;
  double Tf = 0.1 * time_scale(plant);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const auto gains = magnitude_optimum(filtered(plant, Tf, n), m);
    if (!gains) return std::nullopt;
    const double next = filter_constant(gains->back(), m, n, K_HF, Ts);
    if (!std::isfinite(next) || !(next > 0)) return std::nullopt;
    if (std::abs(next - Tf) <= 1e-11 * Tf) return NoiseGainDesign{next, *gains};
    Tf = next;
  }
  return std::nullopt;
}

}  // namespace portrait::rules
