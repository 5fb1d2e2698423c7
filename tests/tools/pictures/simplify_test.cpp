#include "tools/pictures/simplify.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace portrait::pictures {
namespace {

constexpr double kWithin = 1e-3;

/// A wave of 1000 high over 0.01 wide, with a jump in the middle.
Outline wave() {
  Outline curve;
  for (int i = 0; i <= 4000; ++i) {
    const double t = i / 4000.0;
    if (i == 2000) curve.push_back({0.01 * t, 0});
    curve.push_back({0.01 * t, 1000 * std::sin(9 * t) + (i >= 2000 ? 500 : 0)});
  }
  return curve;
}

double value_at(const Outline& curve, double x) {
  std::size_t k = 1;
  while (k + 1 < curve.size() && curve[k].x < x) ++k;
  const Point a = curve[k - 1], b = curve[k];
  return b.x > a.x ? std::lerp(a.y, b.y, (x - a.x) / (b.x - a.x)) : b.y;
}

TEST(Simplified, LooksTheSameWithFarFewerPoints) {
  const Outline curve = wave(), fewer = simplified(curve, kWithin);
  EXPECT_LT(fewer.size(), 120U);
  EXPECT_EQ(fewer.front().x, curve.front().x);
  EXPECT_EQ(fewer.back().y, curve.back().y);
  for (const Point p : curve) {
    if (std::abs(p.x - 0.005) < 1e-5) continue;  // within the jump
    // A distance of kWithin across the curve is more than that upwards where it is steep: 9 spans of y per span of x.
    EXPECT_NEAR(value_at(fewer, p.x), p.y, 10 * kWithin * 2500);
  }
}

TEST(Simplified, KeepsCornersAndJumps) {
  const Outline curve = wave(), fewer = simplified(curve, kWithin);
  const auto has = [&](double x, double y) {
    for (const Point p : fewer)
      if (p.x == x && p.y == y) return true;
    return false;
  };
  EXPECT_TRUE(has(0.005, 0));
  const Outline corner = simplified({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}, kWithin);
  ASSERT_EQ(corner.size(), 3U);
  EXPECT_EQ(corner[1].x, 2);
  EXPECT_EQ(corner[1].y, 0);
}

TEST(Simplified, TakesWhatHasNoExtentAndGaps) {
  EXPECT_EQ(simplified({}, kWithin).size(), 0U);
  EXPECT_EQ(simplified({{1, 1}}, kWithin).size(), 1U);
  EXPECT_EQ(simplified({{1, 1}, {1, 1}, {1, 1}}, kWithin).size(), 2U);
  const Outline gap = simplified({{0, 0}, {1, 0}, {2, NAN}, {3, 0}, {4, 0}}, kWithin);
  EXPECT_TRUE(std::any_of(gap.begin(), gap.end(), [](Point p) { return std::isnan(p.y); }));
}

}  // namespace
}  // namespace portrait::pictures
