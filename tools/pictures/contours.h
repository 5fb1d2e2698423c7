/// Level lines and filled levels of a function known on the nodes of a rectangular grid.
///
/// Between nodes the function is linear along the edges of a cell, in the coordinate in which the axis is drawn.
/// Where a corner of a cell is not finite, the triangle of the other three is used; with fewer the cell is left out.
/// Of a saddle the two high corners are taken as connected, by areas and lines alike.
/// cost      a few operations a cell and level
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace portrait::pictures {

struct Point {
  double x, y;
};
using Outline = std::vector<Point>;

/// z[j * x.size() + i] at (x[i], y[j]); both increasing and finite.
struct Field {
  std::vector<double> x, y, z;
  bool log_x = false, log_y = false;  ///< interpolate in the logarithm; needs values above 0

  double at(std::size_t node) const { return z[node]; }
  Point point(std::size_t node) const { return {x[node % x.size()], y[node / x.size()]}; }
};

/// Where a level is crossed between two neighbouring nodes, the lower number first.
using Crossing = std::function<Point(std::size_t node_a, std::size_t node_b)>;

/// By linear interpolation. REQUIRES: the level lies between the two values.
Crossing interpolated(const Field& field, double level);

/// Closed outlines that together cover where the function is at least `level`; those of neighbouring whole cells of
/// a row are one.
std::vector<Outline> areas_above(const Field& field, double level, const Crossing& crossing);

/// The lines on which the function crosses `level`, as long as they go; closed ones end where they began.
std::vector<Outline> lines_at(const Field& field, double level, const Crossing& crossing);

}  // namespace portrait::pictures
