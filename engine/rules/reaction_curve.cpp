#include "engine/rules/reaction_curve.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "engine/base/matrices.h"

namespace portrait::rules {
namespace {

/// y' = c e^{At} b and y as its integral, of a plant in controllable form with an integrator behind it.
class StepResponse {
 public:
  StepResponse(const Polynomial& N, const Polynomial& D) {
    const auto order = static_cast<Eigen::Index>(D.size() - 1);
    A_ = Eigen::MatrixXd::Zero(order + 1, order + 1);
    start_ = Eigen::VectorXd::Zero(order + 1);
    slope_ = Eigen::RowVectorXd::Zero(order + 1);
    for (Eigen::Index i = 0; i + 1 < order; ++i) A_(i, i + 1) = 1;
    for (Eigen::Index i = 0; i < order; ++i) {
      A_(order - 1, i) = -D[static_cast<std::size_t>(i)] / D.back();
      if (static_cast<std::size_t>(i) < N.size()) slope_(i) = N[static_cast<std::size_t>(i)] / D.back();
    }
    A_.row(order) = slope_;
    start_(order - 1) = 1;
  }

  Eigen::VectorXd state(double t) const { return exponential(A_ * t) * start_; }
  Eigen::MatrixXd step(double t) const { return exponential(A_ * t); }
  const Eigen::VectorXd& start() const { return start_; }
  double slope(const Eigen::VectorXd& x) const { return slope_ * x; }
  double curvature(const Eigen::VectorXd& x) const { return slope_ * A_ * x; }
  double output(const Eigen::VectorXd& x) const { return x(x.size() - 1); }

 private:
  Eigen::MatrixXd A_;
  Eigen::VectorXd start_;
  Eigen::RowVectorXd slope_;
};

/// Long enough for the slowest of the poles left of 0 to die out.
double window(const Polynomial& D) {
  double slowest = 0;
  for (const std::complex<double>& p : complex_roots(D))
    if (p.real() != 0) slowest = std::max(slowest, 1 / std::abs(p.real()));
  return slowest > 0 ? 30 * slowest : 1;
}

/// Of the curvature between two instants that have the steepest one between them.
double turning_point(const StepResponse& y, double left, double right) {
  const bool rising = y.curvature(y.state(left)) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (left + right);
    ((y.curvature(y.state(middle)) > 0) == rising ? left : right) = middle;
  }
  return 0.5 * (left + right);
}

}  // namespace

std::optional<ReactionCurve> reaction_curve(const Polynomial& N, const Polynomial& D, double dead_time) {
  constexpr int kPoints = 6000;
  const StepResponse y(N, D);
  const double dt = window(D) / kPoints;
  const Eigen::MatrixXd step = y.step(dt);
  Eigen::VectorXd x = y.start();
  int best = 0;
  // Of a plant that first answers the wrong way, the slope towards where it ends.
  const double N0 = N[0], D0 = *std::find_if(D.begin(), D.end(), [](double a) { return a != 0; });
  const double direction = std::copysign(1.0, N0 * D0);
  double steepest = direction * y.slope(x);
  for (int i = 1; i <= kPoints; ++i) {
    x = step * x;
    // A slope that only tends to its limit is reached at the end, within rounding.
    if (const double slope = direction * y.slope(x); slope > steepest + 1e-12 * std::abs(steepest))
      steepest = slope, best = i;
  }
  if (best == kPoints && std::abs(y.curvature(x)) * dt * kPoints > 1e-6 * steepest) return std::nullopt;
  const double at = best == 0 || best == kPoints ? best * dt : turning_point(y, (best - 1) * dt, (best + 1) * dt);
  const Eigen::VectorXd there = y.state(at);
  const double slope = y.slope(there);
  if (!(direction * slope > 0)) return std::nullopt;
  return ReactionCurve{slope, at - y.output(there) / slope + dead_time, at + dead_time};
}

}  // namespace portrait::rules
