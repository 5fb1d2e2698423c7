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

TEST(Front, ThinningKeepsOnePointACell) {
  const std::vector<Point> points = cloud(5000);
  const auto kept = thinned(points, 10, 5);
  EXPECT_EQ(kept.size(), 50U);
  EXPECT_EQ(thinned({{1, 1}, {1, 1}}, 10, 5).size(), 1U);
  EXPECT_TRUE(thinned({}, 10, 5).empty());
}

}  // namespace
}  // namespace portrait::pictures
