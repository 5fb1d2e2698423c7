/// The definition of TVm taken literally, by trying every shape, against the one-pass search.
#include "engine/measures/variation.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/check.h"

namespace portrait {
namespace {

using Points = std::vector<double>;

/// Largest variation of a shape that has come to `last` and may pass `extremes` more of x[next..], the next
/// one on the given side of x(inf): +1 above, -1 below, 0 either.
double best_rest(const Points& x, std::size_t next, double last, double x_infinity, int extremes, int side) {
  double best = std::abs(x_infinity - last);
  if (extremes == 0) return best;
  for (std::size_t i = next; i < x.size(); ++i) {
    const int here = x[i] > x_infinity ? 1 : x[i] < x_infinity ? -1 : 0;
    if (here == 0 || (side != 0 && here != side)) continue;
    best = std::max(best, std::abs(x[i] - last) + best_rest(x, i + 1, x[i], x_infinity, extremes - 1, -here));
  }
  return best;
}

double deviation_by_trying_all(const Points& x, double x_infinity, int m) {
  Points whole = x;
  whole.push_back(x_infinity);
  return total_variation(whole) - best_rest(x, 1, x.front(), x_infinity, m, 0);
}

TEST(TotalVariation, SumsTheIncrements) {
  EXPECT_EQ(total_variation(Points{}), 0);
  EXPECT_EQ(total_variation(Points{3}), 0);
  EXPECT_EQ(total_variation(Points{0, 1}), 1);
  EXPECT_EQ(total_variation(Points{0, 2, -1, 1}), 7);
}

TEST(ShapeDeviation, OfAMonotonicResponseIsZero) {
  for (int m = 0; m <= 4; ++m) EXPECT_EQ(shape_deviation(Points{0, 0.25, 0.5, 1}, 1, m), 0) << m;
}

TEST(ShapeDeviation, OfASingleOvershootIsTwiceItsHeight) {
  EXPECT_EQ(shape_deviation(Points{0, 1.25, 1}, 1, 0), 0.5);  // [Huba2022, below (2)]: 2 Delta
  EXPECT_EQ(shape_deviation(Points{0, 1.25, 1}, 1, 1), 0);
}

TEST(ShapeDeviation, OfOnePulseIsZeroFromOneExtremeOn) {
  const Points pulse{0, 3, 0};
  EXPECT_EQ(shape_deviation(pulse, 0, 0), 6);
  for (int m = 1; m <= 4; ++m) EXPECT_EQ(shape_deviation(pulse, 0, m), 0);
}

TEST(ShapeDeviation, OfTwoPulsesIsZeroFromTwoExtremesOn) {
  const Points pulses{0, 2, -1, 0};
  EXPECT_EQ(shape_deviation(pulses, 0, 0), 6);
  EXPECT_EQ(shape_deviation(pulses, 0, 1), 2);  // less 0, 2, 0
  for (int m = 2; m <= 4; ++m) EXPECT_EQ(shape_deviation(pulses, 0, m), 0);
}

TEST(ShapeDeviation, FollowsTheFormulasOfOneAndTwoPulses) {
  // A ripple of 0.5 after the second extreme; x(0-) = 1, x(inf) = 0.5.                 [Huba2022 (3), (5)]
  const Points u{1, 4, -2, 0, -0.5, 0.5};
  const double TV = 3 + 6 + 2 + 0.5 + 1, u0 = 1, u_end = 0.5, um1 = 4, um2 = -2;
  EXPECT_EQ(shape_deviation(u, u_end, 1), TV - std::abs(2 * um1 - u_end - u0));
  EXPECT_EQ(shape_deviation(u, u_end, 2), TV - std::abs(2 * um1 - 2 * um2 + (u_end - u0)));
}

TEST(ShapeDeviation, TwoExtremesOnTheSameSideAreNoTwoPulses) {
  EXPECT_EQ(shape_deviation(Points{0, 2, 1, 3, 0}, 0, 2), 2);
  EXPECT_EQ(shape_deviation(Points{0, 2, 1, 3, 0}, 0, 4), 2);
}

TEST(ShapeDeviation, APointAtRestIsNoExtreme) {
  EXPECT_EQ(shape_deviation(Points{0, 1, 0, 1, 0}, 0, 3), 2);
  EXPECT_EQ(shape_deviation(Points{1, 0, 2, 0}, 0, 2), 2);
}

TEST(ShapeDeviation, TheExtremesKeepTheirOrderInTime) {
  // The highest comes after the lowest: up and down again must do with the lower peak.
  EXPECT_EQ(shape_deviation(Points{0, 1, -3, 4, 0}, 0, 2), 2);
  EXPECT_EQ(shape_deviation(Points{0, 1, -3, 4, 0}, 0, 3), 0);
}

TEST(ShapeDeviation, FewerExtremesThanAllowedMayBeBest) {
  EXPECT_EQ(shape_deviation(Points{0, 0.5, 2, 1.5, 1}, 1, 4), 0);
  EXPECT_EQ(shape_deviation(Points{0, 0.5, 0.25, 1}, 1, 4), 0.5);
}

TEST(ShapeDeviation, AJumpAtTheStartBelongsToTheShape) {
  EXPECT_EQ(shape_deviation(Points{0, 5, 1}, 1, 1), 0);
  EXPECT_EQ(shape_deviation(Points{0, 5, 1}, 1, 0), 8);
}

TEST(ShapeDeviation, OfAResponseCutOffEarlyIsNotBelowZero) {
  EXPECT_EQ(shape_deviation(Points{0, 0.5}, 1, 0), 0);
  EXPECT_EQ(shape_deviation(Points{0, 3}, 0, 1), 0);
  EXPECT_EQ(shape_deviation(Points{0}, 1, 0), 0);
  EXPECT_EQ(shape_deviation(Points{0, 2, -1}, 0, 2), 0);
}

/// Small whole numbers: sums are exact, and points often coincide with each other and with x(inf).
TEST(ShapeDeviation, AgreesWithTryingEveryShape) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20'000; ++trial) {
    Points x(1 + random() % 9);
    for (double& point : x) point = static_cast<double>(random() % 9) - 4;
    const double x_infinity = static_cast<double>(random() % 5) - 2;
    for (int m = 0; m <= 4; ++m)
      ASSERT_EQ(shape_deviation(x, x_infinity, m), deviation_by_trying_all(x, x_infinity, m))
          << "m " << m << " x(inf) " << x_infinity << " x " << testing::PrintToString(x);
  }
}

TEST(ShapeDeviation, IsNeverNegativeAndFallsWithM) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5'000; ++trial) {
    Points x(1 + random() % 40);
    for (double& point : x) point = normal(random);
    const double x_infinity = normal(random);
    double last = total_variation(x) + std::abs(x_infinity - x.back());
    for (int m = 0; m <= 4; ++m) {
      const double deviation = shape_deviation(x, x_infinity, m);
      ASSERT_GE(deviation, -1e-13);
      ASSERT_LE(deviation, last);
      last = deviation;
    }
  }
}

TEST(ShapeDeviation, RefusesNoPointsAndNegativeM) {
  EXPECT_THROW(shape_deviation(Points{}, 0, 0), BrokenPromise);
  EXPECT_THROW(shape_deviation(Points{0}, 0, -1), BrokenPromise);
}

/// The extremes of a fourth-order system's control signal.                                 [Huba2021 (44), (45)]
TEST(ShapeDeviation, OfTheFivePointsOfHuba2021) {
  const Points u{0, 1.68, 0.80, 1.05, 0.98, 1};
  const double published[] = {1.9, 0.54, 0.14, 0.04, 0};
  EXPECT_NEAR(total_variation(u), 2.9, 1e-14);
  for (int m = 0; m <= 8; ++m) EXPECT_NEAR(shape_deviation(u, 1, m), m <= 4 ? published[m] : 0, 1e-14) << m;
  EXPECT_EQ(alternating_extremes(u, 1, 0.01), 4);
  EXPECT_EQ(alternating_extremes(u, 1, 0.03), 3) << "0.98 is within the tolerance";
}

TEST(AlternatingExtremes, CountsWhatLiesBeyondTheTolerance) {
  EXPECT_EQ(alternating_extremes(Points{0, 0.5, 1}, 1, 0.01), 0) << "monotonic";
  EXPECT_EQ(alternating_extremes(Points{0, 0.6, 0.4, 1}, 1, 0.01), 0) << "no extreme beyond the start";
  EXPECT_EQ(alternating_extremes(Points{0, -0.5, 1}, 1, 0.01), 1) << "an inverse response has one";
  EXPECT_EQ(alternating_extremes(Points{0, 2, 1.5, 3, 1}, 1, 0.01), 1) << "on one side they are one pulse";
  EXPECT_EQ(alternating_extremes(Points{0, 1, 0}, 0, 0.01), 1);
  EXPECT_EQ(alternating_extremes(Points{0, 1, -1, 1, 0}, 0, 0.01), 3);
  EXPECT_EQ(alternating_extremes(Points{0}, 0, 0), 0);
  EXPECT_EQ(alternating_extremes(Points{1, 1.25, 0.75, 1}, 1, 0.25), 0) << "what lies at the tolerance is within it";
  EXPECT_EQ(alternating_extremes(Points{0, -0.25, 1}, 1, 0.25), 0) << "no further beyond the start than the tolerance";
}

}  // namespace
}  // namespace portrait
