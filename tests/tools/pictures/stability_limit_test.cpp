#include "tools/pictures/stability_limit.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace portrait::pictures {
namespace {

/// ipdt with PI: on the limit, at omega, tan(omega) = omega tau_i and kappa = omega^2 tau_i/sqrt(1 + (omega tau_i)^2).
double critical_kappa(double tau_i) {
  double low = 1e-9, high = std::numbers::pi / 2 - 1e-12;
  for (int i = 0; i < 200; ++i) {
    const double omega = 0.5 * (low + high);
    (std::tan(omega) < omega * tau_i ? low : high) = omega;
  }
  const double omega = low;
  return omega * omega * tau_i / std::sqrt(1 + omega * tau_i * omega * tau_i);
}

TEST(StabilityLimit, OfIpdtWithPiIsTheClosedForm) {
  const Plane plane{{{Plant::ipdt, 0, Prefilter::pi}, {}}, Parameter::kappa, Parameter::tau_i};
  const Field field = stability(plane, spread(0.05, 2, 40, false), spread(2, 20, 19, false));
  const auto limit = stability_limit(plane, field);
  ASSERT_EQ(limit.size(), 1U);
  for (const Point& p : limit[0]) EXPECT_NEAR(p.x, critical_kappa(p.y), 2e-6) << p.y;
}

TEST(StabilityLimit, InvalidLoopsAreLeftOut) {
  const Plane plane{{{Plant::ipdt, 0, Prefilter::pi}, {}}, Parameter::kappa, Parameter::tau_i};
  const Field field = stability(plane, {0, 0.5, 3}, {2, 5});
  EXPECT_TRUE(std::isnan(field.at(0)));
  EXPECT_EQ(field.at(1), 1);
  EXPECT_EQ(field.at(2), -1);
}

TEST(StabilityLimit, TauDIsSetAfterKappa) {
  const Plane plane{{{Plant::dipdt, 0, Prefilter::pi}, {}}, Parameter::tau_d, Parameter::kappa};
  EXPECT_DOUBLE_EQ(plane.at(3, 0.2).setting.delta, 0.6);
}

TEST(StabilityLimit, SpreadKeepsItsEnds) {
  EXPECT_EQ(spread(1, 3, 3, false), (std::vector<double>{1, 2, 3}));
  const auto decades = spread(0.01, 100, 5, true);
  EXPECT_NEAR(decades[2], 1, 1e-12);
}

}  // namespace
}  // namespace portrait::pictures
