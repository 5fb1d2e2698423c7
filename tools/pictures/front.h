/// Two objectives against each other: the settings, their Pareto front, and what is set beside it. With Ms along x it is
/// the figure J over Ms.                                                                     [Dalen2018 Figures 3, 6, 8]
#pragma once

#include <string>
#include <vector>

#include "tools/pictures/map.h"

namespace portrait::pictures {

struct Front {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Point> settings;  ///< dominated ones, as a cloud
  Outline front;                ///< from the least x to the least y
  std::vector<Mark> marks;
  std::vector<Mark> rules;  ///< with a number beside each
};

Script script(const Front& front);

/// Positions of at most one point for each of columns x rows cells over the points' bounds, the first in each.
std::vector<std::size_t> thinned_positions(const std::vector<Point>& points, std::size_t columns, std::size_t rows);
/// The points there.
std::vector<Point> thinned(const std::vector<Point>& points, std::size_t columns, std::size_t rows);

}  // namespace portrait::pictures
