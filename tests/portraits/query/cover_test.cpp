/// Covers of functions whose greatest values are known.
#include "portraits/query/cover.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/oracle/random.h"

namespace portrait {
namespace {

using Function = std::function<double(const BoxPoint&)>;

CoverProblem problem(std::vector<std::size_t> directions, const Function& f, double limit,
                     double tolerance = kInf) {
  return {.directions = std::move(directions),
          .functions = 1,
          .probe =
              [f](const std::vector<BoxPoint>& points) {
                std::vector<double> values;
                for (const BoxPoint& point : points) values.push_back(f(point));
                return values;
              },
          .limit = {limit},
          .tolerance = {tolerance}};
}

TEST(Cover, bounds_what_lies_between_points) {
  // Downwards all of the second difference, of which a parabola would need an eighth; upwards a quarter.
  EXPECT_EQ(rise_between(0, 1, 0), 2);
  EXPECT_EQ(rise_between(0, 0, 0), 0);
  EXPECT_EQ(rise_between(1, 2, 3), 0);
  EXPECT_EQ(rise_between(1, 0, 1), 0.5);
  EXPECT_EQ(rise_between(0, kInf, 0), kInf);
  EXPECT_EQ(rise_between(-kInf, -kInf, -kInf), 0);
}

TEST(Cover, finds_a_peak_between_the_points) {
  const auto f = [](const BoxPoint& p) {
    return 3 - std::pow(p[0] - 0.3137, 2) - 2 * std::pow(p[1] - 0.871, 2) + 0.5 * (p[0] - 0.3137) * (p[1] - 0.871);
  };
  const Cover found = cover(problem({0, 1}, f, kInf, 1e-3));
  EXPECT_NEAR(found.greatest[0].value, 3, 1e-9);
  EXPECT_NEAR(found.greatest[0].at[0], 0.3137, 1e-4);
  EXPECT_GE(found.greatest[0].bound, 3);
  EXPECT_LE(found.greatest[0].bound, 3 + 1.1e-3);
  EXPECT_EQ(cover(problem({0, 1}, f, 2.9999)).outcome, Outcome::beyond);
  EXPECT_EQ(cover(problem({0, 1}, f, 3.0001)).outcome, Outcome::within);
}

TEST(Cover, takes_few_points_where_the_limit_is_far) {
  const auto f = [](const BoxPoint& p) { return std::sin(p[0] + p[1] + p[2]); };
  const Cover found = cover(problem({0, 1, 2}, f, 5));
  EXPECT_EQ(found.outcome, Outcome::within);
  EXPECT_LE(found.points, 400u);  // 5^3 and the climb
}

TEST(Cover, of_no_direction_is_one_point) {
  const Cover found = cover(problem(
      {}, [](const BoxPoint&) { return 1.0; }, 1));
  EXPECT_EQ(found.outcome, Outcome::within);
  EXPECT_EQ(found.points, 1u);
  EXPECT_EQ(found.greatest[0].bound, 1);
  EXPECT_EQ(cover(problem(
                      {}, [](const BoxPoint&) { return 1.0; }, 0.9))
                .outcome,
            Outcome::beyond);
}

TEST(Cover, says_when_it_decides_nothing) {
  // As rough as can be: no second difference is small.
  const auto f = [](const BoxPoint& p) { return std::sin(1e7 * (p[0] + 1.7 * p[1])); };
  const Cover found = cover(problem({0, 1}, f, 1));
  EXPECT_EQ(found.outcome, Outcome::open);
  EXPECT_LE(found.points, 2 * kMostPoints);
}

TEST(Cover, of_one_direction_is_halved_as_far_as_points_differ) {
  const Cover found = cover(problem(
      {0}, [](const BoxPoint& p) { return std::sin(1e7 * p[0]); }, 1));
  EXPECT_EQ(found.outcome, Outcome::open);
  EXPECT_LE(found.points, 5000u);  // 4097 and the climb
}

TEST(Cover, stops_at_the_first_value_beyond) {
  const auto f = [](const BoxPoint& p) { return p[0] == 0 && p[1] == 0 ? kInf : 0.0; };
  const Cover found = cover(problem({0, 1}, f, 1));
  EXPECT_EQ(found.outcome, Outcome::beyond);
  EXPECT_EQ(found.points, 25u);
  EXPECT_EQ(found.greatest[0].at, (BoxPoint{0, 0, 0}));
}

/// Smooth waves and tents, as measures are: the smaller or larger of two, or one alone.
Function random_function(oracle::Random& random) {
  const auto smooth = [&] {
    const double a = random.uniform(-3, 3), b = random.uniform(-3, 3), c = random.uniform(0, 6),
                 d = random.uniform(0, 6);
    return
        [=](const BoxPoint& p) { return std::sin(a * p[0] + b * p[1] + c) + 0.3 * std::cos(d * p[1] + a * p[0]); };
  };
  const auto first = smooth();
  const auto second = smooth();
  const int kind = random.below(3);
  return [=](const BoxPoint& p) {
    return kind == 0 ? first(p) : kind == 1 ? std::min(first(p), second(p)) : std::max(first(p), second(p));
  };
}

TEST(Cover, bound_holds_over_random_functions) {
  oracle::Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Function f = random_function(random);
    const Cover found = cover(problem({0, 1}, f, kInf, 0.05));
    double greatest = -kInf;
    for (int j = 0; j <= 100; ++j)
      for (int k = 0; k <= 100; ++k) greatest = std::max(greatest, f({0.01 * j, 0.01 * k, 0}));
    EXPECT_GE(found.greatest[0].bound, greatest) << i;
    EXPECT_LE(found.greatest[0].bound, found.greatest[0].value + 0.051) << i;
  }
}

}  // namespace
}  // namespace portrait
