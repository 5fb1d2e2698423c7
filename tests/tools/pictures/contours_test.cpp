#include "tools/pictures/contours.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace portrait::pictures {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <typename Function>
Field field(std::size_t nx, std::size_t ny, Function f) {
  Field result;
  for (std::size_t i = 0; i < nx; ++i) result.x.push_back(static_cast<double>(i));
  for (std::size_t j = 0; j < ny; ++j) result.y.push_back(2.0 * static_cast<double>(j));
  for (const double y : result.y)
    for (const double x : result.x) result.z.push_back(f(x, y));
  return result;
}

double area(const Outline& outline) {
  double twice = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Point a = outline[k], b = outline[(k + 1) % outline.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

double area(const Field& field, double level) {
  double sum = 0;
  for (const Outline& outline : areas_above(field, level, interpolated(field, level))) {
    EXPECT_GE(area(outline), 0);  // counterclockwise, all of them
    sum += area(outline);
  }
  return sum;
}

TEST(Contours, AreasOfAPlane) {
  // z = x over [0, 5] x [0, 6]: at or above t is a strip of width 5 - t.
  const Field plane = field(6, 4, [](double x, double) { return x; });
  for (const double t : {0.25, 1.0, 3.5, 4.999}) EXPECT_NEAR(area(plane, t), (5 - t) * 6, 1e-12) << t;
  EXPECT_NEAR(area(plane, -1), 30, 1e-12);
  EXPECT_EQ(area(plane, 6), 0);
}

TEST(Contours, WholeCellsOfARowAreOneOutline) {
  const Field plane = field(6, 4, [](double, double) { return 1.0; });
  EXPECT_EQ(areas_above(plane, 0, interpolated(plane, 0)).size(), 3U);  // a row each
}

TEST(Contours, LineOfAPlaneIsStraightAndWhole) {
  const Field plane = field(6, 4, [](double x, double y) { return x + y; });
  const auto lines = lines_at(plane, 4.5, interpolated(plane, 4.5));
  ASSERT_EQ(lines.size(), 1U);
  for (const Point& p : lines[0]) EXPECT_NEAR(p.x + p.y, 4.5, 1e-12);
  EXPECT_NEAR(std::abs(lines[0].front().x - lines[0].back().x), 4.5, 1e-12);  // from (0, 4.5) to (4.5, 0)
}

TEST(Contours, LineAroundAHillIsClosed) {
  const Field hill = field(21, 11, [](double x, double y) { return -std::hypot(x - 10, y - 10); });
  const auto lines = lines_at(hill, -6, interpolated(hill, -6));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front().x, lines[0].back().x);
  EXPECT_EQ(lines[0].front().y, lines[0].back().y);
  for (const Point& p : lines[0]) EXPECT_NEAR(std::hypot(p.x - 10, p.y - 10), 6, 0.2);
  EXPECT_NEAR(area(hill, -6), std::abs(area(lines[0])), 1e-9);  // what is filled is what the line runs around
}

TEST(Contours, SaddleJoinsTheHighCorners) {
  const Field saddle = field(2, 2, [](double x, double y) { return (x < 0.5) == (y < 1) ? 1.0 : 0.0; });
  const auto lines = lines_at(saddle, 0.5, interpolated(saddle, 0.5));
  EXPECT_EQ(lines.size(), 2U);
  EXPECT_NEAR(area(saddle, 0.5), 2 - 2 * 0.25, 1e-12);  // the cell less the triangles at both low corners
}

TEST(Contours, MissingCornersLeaveTrianglesOrNothing) {
  Field plane = field(3, 2, [](double, double) { return 1.0; });
  plane.z[0] = kNaN;
  EXPECT_NEAR(area(plane, 0), 2 + 1, 1e-12);
  plane.z[4] = kNaN;  // of both cells: the first keeps two corners, the second three
  EXPECT_NEAR(area(plane, 0), 1, 1e-12);
}

TEST(Contours, LogarithmicAxisInterpolatesInTheLogarithm) {
  Field decade{{1, 100}, {0, 1}, {0, 2, 0, 2}, true, false};
  const auto lines = lines_at(decade, 1, interpolated(decade, 1));
  ASSERT_EQ(lines.size(), 1U);
  for (const Point& p : lines[0]) EXPECT_NEAR(p.x, 10, 1e-12);
}

}  // namespace
}  // namespace portrait::pictures
