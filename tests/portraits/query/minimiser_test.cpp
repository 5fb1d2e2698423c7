/// Problems whose answer is known.
#include "portraits/query/minimiser.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace portrait {
namespace {

using Point = std::vector<double>;

MinimiserProblem problem(const std::function<Probe(const Point&)>& one, Point start, double low = -10,
                         double high = 10) {
  const std::size_t n = start.size();
  return {[one](const std::vector<Point>& points) {
            std::vector<Probe> probes;
            for (const Point& point : points) probes.push_back(one(point));
            return probes;
          },
          Point(n, low), Point(n, high), std::move(start)};
}

double square(double x) { return x * x; }

TEST(Minimiser, of_a_curved_valley) {
  const Minimum found = minimise(problem(
      [](const Point& x) {
        return Probe{100 * square(x[1] - x[0] * x[0]) + square(1 - x[0]) + 1, {}};
      },
      {-1.2, 1}));
  EXPECT_NEAR(found.point[0], 1, 2e-5);
  EXPECT_NEAR(found.point[1], 1, 4e-5);
  EXPECT_NEAR(found.probe.objective, 1, 1e-9);
}

TEST(Minimiser, on_a_curved_limit) {
  const Minimum found = minimise(problem(
      [](const Point& x) {
        return Probe{x[0] + 2 * x[1] + 5, {x[0] * x[0] + x[1] * x[1] - 1}};
      },
      {0, 0}));
  EXPECT_NEAR(found.point[0], -1 / std::sqrt(5), 1e-6);
  EXPECT_NEAR(found.point[1], -2 / std::sqrt(5), 1e-6);
  EXPECT_LE(found.probe.constraints[0], 0);
  EXPECT_GT(found.probe.constraints[0], -1e-8);
  EXPECT_NEAR(found.prices[0], std::sqrt(5) / 2, 1e-5);  // objective 5 - sqrt(5 r) on the circle x^2 + y^2 = r
  EXPECT_TRUE(found.converged);
}

/// From a start whose first step of the model does not lead there.
TEST(Minimiser, is_led_back_to_a_limit_that_curves_away) {
  const Minimum found = minimise(problem(
      [](const Point& x) {
        return Probe{x[0] + 2 * x[1] + 5, {square(x[0] - 0.5) + square(x[1] + 0.3) - 9}};
      },
      {1, 1}));
  EXPECT_NEAR(found.point[0], 0.5 - 3 / std::sqrt(5), 1e-6);
  EXPECT_NEAR(found.point[1], -0.3 - 6 / std::sqrt(5), 1e-6);
  EXPECT_NEAR(found.prices[0], std::sqrt(5) / 6, 1e-5);
}

TEST(Minimiser, in_a_corner_of_two_limits_and_at_a_bound) {
  const auto one = [](const Point& x) {
    return Probe{square(x[0] - 3) + square(x[1] - 3) + square(x[2] + 20),
                 {x[0] + 2 * x[1] - 3, x[0] - 1 - 0.1 * x[1] * x[1]}};
  };
  const Minimum found = minimise(problem(one, {0, 0, 0}));
  EXPECT_NEAR(found.point[2], -10, 1e-9);
  const Probe at = one(found.point);
  EXPECT_LE(at.constraints[0], 0);
  EXPECT_LE(at.constraints[1], 0);
  EXPECT_NEAR(at.constraints[0], 0, 1e-8);
  // By scanning the line x + 2 y = 3, which is active at the optimum.
  double best = 1e9;
  for (double y = -2; y <= 3; y += 1e-6) {
    const Probe scanned = one({3 - 2 * y, y, -10});
    if (scanned.constraints[1] <= 0) best = std::min(best, scanned.objective);
  }
  EXPECT_NEAR(found.probe.objective, best, 1e-5);
}

TEST(Minimiser, comes_past_a_kink) {
  const Minimum found = minimise(problem(
      [](const Point& x) {
        return Probe{std::abs(x[0] - 0.3) + std::abs(x[1] + 0.2) + square(x[0] - x[1]), {}};
      },
      {4, 3}));
  EXPECT_NEAR(found.probe.objective, 0.25, 2e-3);  // |x - .3| + |y + .2| + (x - y)^2 at x = .3, y = -.2
}

TEST(Minimiser, keeps_away_from_where_nothing_exists) {
  const Minimum found = minimise(problem(
      [](const Point& x) {
        return Probe{x[0] > 2 ? std::numeric_limits<double>::infinity() : square(x[0] - 1.9), {}};
      },
      {-3}));
  EXPECT_NEAR(found.point[0], 1.9, 1e-5);
}

TEST(Minimiser, goes_to_a_least_value_of_0) {
  const Minimum found = minimise(problem(
      [](const Point& x) {
        return Probe{100 * square(x[1] - x[0] * x[0]) + square(1 - x[0]), {}};
      },
      {-1.2, 1}));
  EXPECT_NEAR(found.point[0], 1, 5e-5);
  EXPECT_NEAR(found.point[1], 1, 1e-4);
}

/// A valley at 0 with two deeper ones a step away, of which the deepest is the answer on either side.
TEST(Minimiser, goes_on_from_the_best_of_what_lies_around) {
  for (const double side : {-1.0, 1.0}) {
    const Minimum found = minimise(problem(
        [side](const Point& x) {
          return Probe{
              10 + std::min({square(x[0]), square(side * x[0] - 1.2) - 0.5, square(side * x[0] + 1.2) - 0.1}), {}};
        },
        {0.0002}));
    EXPECT_NEAR(found.point[0], 1.2 * side, 1e-5);
    EXPECT_NEAR(found.probe.objective, 9.5, 1e-9);
  }
}

}  // namespace
}  // namespace portrait
