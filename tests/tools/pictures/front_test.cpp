#include "tools/pictures/front.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace portrait::pictures {
namespace {

std::vector<Point> cloud(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> values(0, 60);  // whole numbers: plenty of ties
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({values(random) / 2.0, values(random) / 2.0});
  return points;
}

bool dominates(Point a, Point b) { return a.x <= b.x && a.y <= b.y && (a.x < b.x || a.y < b.y); }

TEST(Front, IsThatOfEveryPairCompared) {
  for (const std::size_t count : {1U, 2U, 10U, 300U}) {
    const std::vector<Point> points = cloud(count);
    const Outline front = pareto_front(points);
    std::size_t not_dominated = 0;
    for (const Point& p : points) {
      const bool beaten = std::any_of(points.begin(), points.end(), [&](Point q) { return dominates(q, p); });
      const bool in_front =
          std::any_of(front.begin(), front.end(), [&](Point q) { return q.x == p.x && q.y == p.y; });
      EXPECT_NE(beaten, in_front) << p.x << " " << p.y;
      if (!beaten) ++not_dominated;
    }
    EXPECT_LE(front.size(), not_dominated);  // equal points are one
    for (std::size_t k = 1; k < front.size(); ++k) {
      EXPECT_LT(front[k - 1].x, front[k].x);
      EXPECT_GT(front[k - 1].y, front[k].y);
    }
  }
}

TEST(Front, ThinningKeepsOnePointACell) {
  const std::vector<Point> points = cloud(5000);
  const auto kept = thinned(points, 10, 5);
  EXPECT_EQ(kept.size(), 50U);
  EXPECT_EQ(thinned({{1, 1}, {1, 1}}, 10, 5).size(), 1U);
  EXPECT_TRUE(thinned({}, 10, 5).empty());
}

}  // namespace
}  // namespace portrait::pictures
