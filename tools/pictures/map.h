/// A plane of settings as filled contours: what Figures 12 and 13 of [Huba2022] show.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tools/pictures/contours.h"
#include "tools/pictures/gnuplot.h"

namespace portrait::pictures {

struct Mark {
  Point at;
  std::string label;
};

struct Map {
  std::string title, x_label, y_label, z_label;
  Field field;         ///< not finite where there is nothing to show; may hold no finite value at all
  bool log_z = false;  ///< levels in equal ratios; needs values above 0
  int levels = 12;
  std::optional<std::pair<double, double>> range;  ///< of the colours; beyond it the end colours are used
  std::vector<Outline> admissible;                 ///< outlines of the admissible region
  std::vector<Point> admissible_settings;
  std::vector<Outline> stability;  ///< the boundary
  std::optional<Mark> optimum;
  std::vector<Mark> marks;
  std::vector<Mark> rules;     ///< with a number beside each
  std::vector<Outline> patch;  ///< where a fixed real controller goes while the plant moves
};

/// Smallest value and the one below which 95 % lie, so that the wall next to instability does not take all colours.
std::pair<double, double> usual_range(const Field& field);
/// Whether the values spread so far, all above 0, that a logarithmic scale shows more.
bool spreads(const std::pair<double, double>& range);

Script script(const Map& map);

/// ", $d3 using 1:2 with points ..." for each mark.
std::string marked(Script& script, const std::vector<Mark>& marks);
/// "[0.05:0.35]": an axis as far as its values go; a single value gets some room.
std::string limits(const std::vector<double>& values, bool log);

}  // namespace portrait::pictures
