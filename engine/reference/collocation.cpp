#include "engine/reference/collocation.h"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "engine/base/check.h"
#include "engine/reference/chebyshev.h"

namespace portrait::reference {
namespace {

/// P_s(x) - P_(s-1)(x), whose zeros on [-1, 1] are the Radau points with x = 1 among them, and its
/// derivative.
struct RadauValue {
  double value, slope;
};

RadauValue radau_polynomial(int s, double x) {
  double p = 1, p_before = 0, slope = 0, slope_before = 0;
  for (int k = 1; k <= s; ++k) {
    const double a = (2.0 * k - 1) / k, b = (k - 1.0) / k;
    const double p_next = a * x * p - b * p_before;
    const double slope_next = a * (p + x * slope) - b * slope_before;
    p_before = p, p = p_next;
    slope_before = slope, slope = slope_next;
  }
  return {p - p_before, slope - slope_before};
}

/// Newton from the Chebyshev-like guess of each zero but the last, which is 1.
Eigen::VectorXd radau_points(int s) {
  Eigen::VectorXd x(s);
  for (int i = 0; i < s; ++i) {
    x(i) = -std::cos(std::numbers::pi * (2.0 * i + 1) / (2.0 * s - 1));
    for (int iteration = 0; iteration < 50 && i < s - 1; ++iteration) {
      const RadauValue r = radau_polynomial(s, x(i));
      x(i) -= r.value / r.slope;
    }
  }
  x(s - 1) = 1;
  return x;
}

/// T_k at the points: a row a point, a column a degree.
Eigen::MatrixXd chebyshev_values(const Eigen::VectorXd& x, Eigen::Index degrees) {
  Eigen::MatrixXd T(x.size(), degrees);
  for (Eigen::Index k = 0; k < degrees; ++k)
    for (Eigen::Index i = 0; i < x.size(); ++i) T(i, k) = value(Series::Unit(degrees, k), x(i));
  return T;
}

/// Integral from the panel's start to each point of T_k, on the panel [0, 1].
Eigen::MatrixXd chebyshev_integrals(const Eigen::VectorXd& x, Eigen::Index degrees) {
  Eigen::MatrixXd S(x.size(), degrees);
  for (Eigen::Index k = 0; k < degrees; ++k) {
    const Series integral = antiderivative(Series::Unit(degrees, k));
    for (Eigen::Index i = 0; i < x.size(); ++i) S(i, k) = 0.5 * value(integral, x(i));
  }
  return S;
}

}  // namespace

Nodes radau_nodes(int stages) {
  PORTRAIT_CHECK(stages >= 1 && stages <= 20);
  const Eigen::VectorXd x = radau_points(stages);
  Eigen::VectorXd with_start(stages + 1);
  with_start << -1, x;
  Nodes nodes;
  nodes.at = (with_start.array() + 1) / 2;
  nodes.integration = chebyshev_integrals(x, stages) * chebyshev_values(x, stages).inverse();
  nodes.to_series = chebyshev_values(with_start, stages + 1).inverse();
  nodes.to_series.col(0) = Eigen::VectorXd::Unit(stages + 1, 0);
  return nodes;
}

Panel::Panel(const OpenChain& chain, const Nodes& nodes, double length)
    : chain_(chain), length_(length), stages_(nodes.stages()) {
  const Eigen::Index n = chain.states(), s = stages_;
  // G_i = X_i - x0 = h sum_j a_ij (x'(0) + A G_j + B (q_j - q_0)): one linear system for all stages.
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(s * n, s * n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(s * n, n + 2 * s);
  for (Eigen::Index i = 0; i < s; ++i) {
    right.block(i * n, 0, n, n).diagonal().setConstant(length * nodes.at(i + 1));
    for (Eigen::Index j = 0; j < s; ++j) {
      const double a = length * nodes.integration(i, j);
      system.block(i * n, j * n, n, n) -= a * chain.A;
      right.block(i * n, n + j, n, 1) = a * chain.B.col(kY);
      right.block(i * n, n + s + j, n, 1) = a * chain.B.col(kYSlope);
    }
  }
  const Eigen::MatrixXd maps = system.partialPivLu().solve(right);
  from_slope_ = maps.leftCols(n);
  from_y_ = maps.middleCols(n, s);
  if (!chain.B.col(kYSlope).isZero(0)) from_y_slope_ = maps.rightCols(s);
}

void Panel::advance(const PanelValues& y, const PanelValues& y_slope, States& x,
                    PanelValues outputs[kOutputs]) const {
  const Eigen::Index n = chain_.states(), s = stages_;
  const States slope =
      chain_.A * x + chain_.B.col(kY) * y.row(0) + chain_.B.col(kYSlope) * y_slope.row(0) + chain_.E;
  States gains = from_slope_ * slope;
  gains.noalias() += from_y_ * y.bottomRows(s);
  if (from_y_slope_.size() > 0) gains.noalias() += from_y_slope_ * y_slope.bottomRows(s);

  for (int p = 0; p < kOutputs; ++p) {
    outputs[p] = chain_.D(p, kY) * y + chain_.D(p, kYSlope) * y_slope;
    outputs[p].row(0) += chain_.C.row(p) * x + chain_.F.row(p);
    for (Eigen::Index i = 0; i < s; ++i) outputs[p].row(i + 1) += chain_.C.row(p) * gains.middleRows(i * n, n);
  }
  x += gains.bottomRows(n);
}

}  // namespace portrait::reference
