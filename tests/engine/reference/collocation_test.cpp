#include "engine/reference/collocation.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/reference/chebyshev.h"

namespace portrait::reference {
namespace {

const double kRoot6 = std::sqrt(6.0);
constexpr Eigen::Index kColumns = 2;  ///< setpoint and disturbance

/// x' = lambda x + q(t) + v_w + 2 v_d,  z = x,  u = q
OpenChain scalar_chain(double lambda) {
  OpenChain chain;
  chain.A = Eigen::MatrixXd::Constant(1, 1, lambda);
  chain.B = Eigen::RowVector2d(1, 0);
  chain.E = Eigen::RowVector2d(1, 2);
  chain.C = Eigen::Vector3d(1, lambda, 0);
  chain.D = Eigen::MatrixXd::Zero(kOutputs, kDelayed);
  chain.D(kU, kY) = 1;
  chain.F = Eigen::MatrixXd::Zero(kOutputs, kColumns);
  chain.fastest = kInf;
  return chain;
}

/// Values at the nodes as PanelValues has them: the first, then what is gained since.
PanelValues panel_values(const Eigen::VectorXd& at_nodes) {
  PanelValues values = at_nodes.replicate(1, kColumns);
  for (Eigen::Index i = 1; i < values.rows(); ++i) values.row(i) -= values.row(0);
  return values;
}

struct Crossed {
  States x;
  PanelValues outputs[kOutputs];
};

/// One panel [start, start + length] of the scalar chain, from x0 in both columns.
Crossed cross(double lambda, int stages, double start, double length, double x0,
              const std::function<double(double)>& q) {
  const OpenChain chain = scalar_chain(lambda);
  const Nodes nodes = radau_nodes(stages);
  const PanelValues y = panel_values(nodes.at.unaryExpr([&](double c) { return q(start + length * c); }));
  Crossed crossed{States::Constant(1, kColumns, x0), {}};
  const PanelValues no_slope = PanelValues::Zero(stages + 1, kColumns);
  Panel(chain, nodes, length).advance(y, no_slope, crossed.x, crossed.outputs);
  return crossed;
}

/// x' = -x + cos t - 1, x(0) = 2: the column of the setpoint, whose v is 1, then solves x' = -x + cos t.
double exact(double t) { return 0.5 * (std::cos(t) + std::sin(t)) + 1.5 * std::exp(-t); }

double error_of_one_panel(int stages, double length) {
  const Crossed crossed = cross(-1, stages, 0, length, 2, [](double t) { return std::cos(t) - 1; });
  return std::abs(crossed.x(0, kSetpoint) - exact(length));
}

double error_at_one(int stages, int panels) {
  double x = 2;
  for (int i = 0; i < panels; ++i) {
    const double h = 1.0 / panels;
    x = cross(-1, stages, i * h, h, x, [](double t) { return std::cos(t) - 1; }).x(0, kSetpoint);
  }
  return std::abs(x - exact(1));
}

void expect_near(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected, double tolerance) {
  ASSERT_EQ(found.rows(), expected.rows());
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance) << found;
}

// The Butcher matrices of Radau IIA.                                              [HairerWanner, IV.5, table 5.5, 5.6]

TEST(RadauNodes, OneStageIsTheBackwardEulerMethod) {
  const Nodes nodes = radau_nodes(1);
  expect_near(nodes.at, Eigen::Vector2d(0, 1), 1e-16);
  expect_near(nodes.integration, Eigen::MatrixXd::Ones(1, 1), 1e-16);
}

TEST(RadauNodes, TwoStages) {
  const Nodes nodes = radau_nodes(2);
  expect_near(nodes.at, Eigen::Vector3d(0, 1.0 / 3, 1), 1e-15);
  Eigen::Matrix2d a;
  a << 5.0 / 12, -1.0 / 12, 3.0 / 4, 1.0 / 4;
  expect_near(nodes.integration, a, 1e-15);
}

TEST(RadauNodes, ThreeStages) {
  const Nodes nodes = radau_nodes(3);
  expect_near(nodes.at, Eigen::Vector4d(0, (4 - kRoot6) / 10, (4 + kRoot6) / 10, 1), 1e-15);
  Eigen::Matrix3d a;
  a << (88 - 7 * kRoot6) / 360, (296 - 169 * kRoot6) / 1800, (-2 + 3 * kRoot6) / 225, (296 + 169 * kRoot6) / 1800,
      (88 + 7 * kRoot6) / 360, (-2 - 3 * kRoot6) / 225,  //
      (16 - kRoot6) / 36, (16 + kRoot6) / 36, 1.0 / 9;
  expect_near(nodes.integration, a, 1e-15);
}

TEST(RadauNodes, IncreaseFromZeroToOne) {
  for (int s = 1; s <= 20; ++s) {
    const Nodes nodes = radau_nodes(s);
    EXPECT_EQ(nodes.at(0), 0);
    EXPECT_EQ(nodes.at(s), 1);
    for (int i = 0; i < s; ++i) EXPECT_LT(nodes.at(i), nodes.at(i + 1));
  }
}

TEST(RadauNodes, IntegratePolynomialsBelowDegreeSExactlyAtEveryNode) {
  for (int s = 1; s <= 20; ++s) {
    const Nodes nodes = radau_nodes(s);
    for (int power = 0; power < s; ++power) {
      const Eigen::VectorXd at = nodes.at.tail(s);
      const Eigen::VectorXd integral = at.array().pow(power + 1) / (power + 1);
      expect_near(nodes.integration * at.array().pow(power).matrix(), integral, 1e-14);
    }
  }
}

TEST(RadauNodes, IntegrateToTheEndExactlyUpToDegreeTwoSMinusTwo) {
  for (int s = 1; s <= 20; ++s) {
    const Nodes nodes = radau_nodes(s);
    const Eigen::RowVectorXd weights = nodes.integration.row(s - 1);
    for (int power = 0; power <= 2 * s - 2; ++power)
      EXPECT_NEAR(weights * nodes.at.tail(s).array().pow(power).matrix(), 1.0 / (power + 1), 1e-14);
    if (s > 6) continue;
    const double beyond = weights * nodes.at.tail(s).array().pow(2 * s - 1).matrix();
    EXPECT_GT(std::abs(beyond - 0.5 / s), 1e-12) << "degree 2 s - 1 is not exact: s = " << s;
  }
}

TEST(RadauNodes, SeriesThroughTheValuesIsThePolynomialItself) {
  const Nodes nodes = radau_nodes(5);
  const auto p = [](double t) { return 3 - t + 2 * t * t - 5 * std::pow(t, 5); };
  const Series c = nodes.to_series * panel_values(nodes.at.unaryExpr(p)).col(0);
  for (const double t : {0.0, 0.2, 0.55, 1.0}) EXPECT_NEAR(value(c, 2 * t - 1), p(t), 1e-14);
}

TEST(RadauNodes, RefuseNoStagesAndTooMany) {
  EXPECT_THROW(radau_nodes(0), BrokenPromise);
  EXPECT_THROW(radau_nodes(21), BrokenPromise);
}

TEST(Panel, IsExactForASolutionThatIsAPolynomialOfDegreeS) {
  for (int s = 2; s <= 14; ++s) {
    const double lambda = -0.7, h = 0.8;
    const auto x = [&](double t) { return 1 + t - std::pow(t, s); };
    const auto slope = [&](double t) { return 1 - s * std::pow(t, s - 1); };
    const Crossed crossed = cross(lambda, s, 0, h, 1, [&](double t) { return slope(t) - lambda * x(t) - 1; });
    const Nodes nodes = radau_nodes(s);
    const PanelValues expected = panel_values(nodes.at.unaryExpr([&](double c) { return x(h * c); }));
    expect_near(crossed.outputs[kZ].col(kSetpoint), expected.col(kSetpoint), 1e-14);
    EXPECT_EQ(1 + crossed.outputs[kZ](s, kSetpoint), crossed.x(0, kSetpoint));
  }
}

/// The reason for gains: with values instead, u of a filter with tau_f = 1e-4 is off by 1e-8 and more.
TEST(Panel, KeepsTheDigitsOfASlopeOnATinyPanel) {
  const double tau_f = 1e-4, large = 100;
  const auto q = [&](double t) { return (large + t) / tau_f - 1; };
  const OpenChain chain = scalar_chain(-1 / tau_f);
  const Nodes nodes = radau_nodes(14);
  PanelValues y = PanelValues::Zero(15, kColumns);
  y.row(0).setConstant(q(0));
  y.bottomRows(14).colwise() = nodes.at.tail(14) * 2;  // (t / tau_f) on a panel of length 2 tau_f
  Crossed crossed{States::Constant(1, kColumns, large - tau_f), {}};
  Panel(chain, nodes, 2 * tau_f).advance(y, PanelValues::Zero(15, kColumns), crossed.x, crossed.outputs);
  for (int i = 1; i <= 14; ++i) EXPECT_NEAR(crossed.outputs[kZ](i, kSetpoint) / tau_f, 2 * nodes.at(i), 1e-10);
}

TEST(Panel, KeepsTheTwoStepsApart) {
  const Crossed crossed = cross(0, 3, 0, 0.5, 1, [](double) { return 4.0; });
  EXPECT_NEAR(crossed.x(0, kSetpoint), 1 + 0.5 * (4 + 1), 1e-15);
  EXPECT_NEAR(crossed.x(0, kDisturbance), 1 + 0.5 * (4 + 2), 1e-15);
  EXPECT_EQ(crossed.outputs[kU](0, kDisturbance), 4);
  EXPECT_EQ(crossed.outputs[kU](2, kDisturbance), 0);
}

TEST(Panel, OneStepHasAnErrorOfOrderTwoS) {
  for (int s = 1; s <= 4; ++s) {
    const double h = s <= 2 ? 0.02 : 0.2;  // small enough for the leading term, large enough for the digits
    const double observed = std::log2(error_of_one_panel(s, 2 * h) / error_of_one_panel(s, h));
    EXPECT_NEAR(observed, 2 * s, 0.25) << "s = " << s;
  }
}

TEST(Panel, AfterManyStepsTheErrorIsOfOrderTwoSMinusOne) {
  for (int s = 1; s <= 4; ++s) {
    const double observed = std::log2(error_at_one(s, 4) / error_at_one(s, 8));
    EXPECT_NEAR(observed, 2 * s - 1, 0.25) << "s = " << s;
  }
}

TEST(Panel, FourteenStagesAreExactToRounding) { EXPECT_LT(error_of_one_panel(14, 1), 5e-15); }

TEST(Panel, DampsWhatIsMuchFasterThanThePanel) {
  for (const int s : {1, 2, 3, 8, 14, 18}) {
    const double lambda = -1e6;
    const Crossed decay = cross(lambda, s, 0, 1, 1, [](double) { return -1.0; });
    EXPECT_LT(std::abs(decay.x(0, kSetpoint)), 50e-6) << "s = " << s;
    const Crossed quasi_static = cross(lambda, s, 0, 1, 1, [&](double t) { return -1 - lambda * (1 + t); });
    EXPECT_NEAR(quasi_static.x(0, kSetpoint), 2 + 1 / lambda, 1e-10) << "s = " << s;
  }
}

}  // namespace
}  // namespace portrait::reference
