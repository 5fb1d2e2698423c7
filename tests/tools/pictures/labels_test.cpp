#include "tools/pictures/labels.h"

#include <cmath>

#include <gtest/gtest.h>

namespace portrait::pictures {
namespace {

constexpr Point kPanel{60, 20};

bool apart(Point a, std::size_t a_width, Point b, std::size_t b_width) {
  return std::abs(a.x - b.x) >= 0.5 * static_cast<double>(a_width + b_width) || std::abs(a.y - b.y) >= 1;
}

Point middle(Point at, LabelPlace place) { return {at.x + place.dx, at.y + place.dy}; }

TEST(Labels, OfACrowdLieApartAndOnNoPoint) {
  const std::vector<Point> at{{30, 10}, {30.5, 10.2}, {31, 9.9}, {30.2, 9.5}, {31, 10.8}};
  const std::vector<std::size_t> widths{1, 1, 2, 2, 1};
  const auto places = label_places(at, widths, {}, kPanel);
  for (std::size_t a = 0; a < at.size(); ++a) {
    const Point here = middle(at[a], places[a]);
    for (std::size_t b = 0; b < a; ++b) EXPECT_TRUE(apart(here, widths[a], middle(at[b], places[b]), widths[b]));
    for (const Point p : at) EXPECT_TRUE(apart(here, widths[a], p, 0));
  }
}

TEST(Labels, StayInThePanelAtItsCorners) {
  const std::vector<Point> at{{0, 0}, {60, 0}, {60, 20}, {0, 20}};
  const auto places = label_places(at, {6, 6, 6, 6}, {}, kPanel);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Point m = middle(at[k], places[k]);
    EXPECT_GE(m.x, 3);
    EXPECT_LE(m.x, 57);
    EXPECT_GE(m.y, 0.5);
    EXPECT_LE(m.y, 19.5);
  }
}

TEST(Labels, LeaveWhatIsDrawnVisible) {
  std::vector<Point> curve;
  for (int i = 0; i <= 200; ++i) curve.push_back({10 + 0.1 * i, 10 + 0.05 * i});  // up to the right
  const auto places = label_places({{10, 10}}, {6}, curve, kPanel);
  for (const Point p : curve) EXPECT_TRUE(apart(middle({10, 10}, places[0]), 6, p, 0));
}

}  // namespace
}  // namespace portrait::pictures
