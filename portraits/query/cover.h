/// The greatest values of functions over a box, with a bound on what may lie between the points where they were evaluated.
///
/// The box is covered with cells, each of which knows the functions at its corners, the middles of its edges and faces and
/// its centre. Along a line of three such points let D be the second difference f(0) - 2 f(1) + f(2). Then between the
/// points f is taken to rise above the greatest of them by at most max(-D, |D|/4), and in a cell by at most the sum of
/// that, the greatest over parallel lines, over the directions. Cells whose bound does not decide are halved along the
/// direction that adds most to it.
///
/// bound     holds for a function whose second derivative along a line is up to eight times (downwards) or twice (where D
///           says upwards) what D says, where a steady one needs D/8; and for one that is bent downwards once in the cell,
///           as the smaller of two smooth ones, whatever the angle. Kinks upwards, as of the larger of two, add nothing.
///           A peak that hides between all points would be missed: hence kFirstCells a direction at once, a climb from
///           every greatest point found, and in robust.h another thousand points.
/// cost      3^d points a cell, shared between neighbours; a function that is far from its limit needs the first cells only
/// accuracy  tests/portraits/query/cover_test.cpp
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "portraits/query/plant_box.h"

namespace portrait {

inline constexpr std::size_t kFirstCells = 2;      ///< along each direction
inline constexpr std::size_t kMostPoints = 20000;  ///< of a cover, before it is left open

struct CoverProblem {
  std::vector<std::size_t> directions;  ///< coordinates of BoxPoint that vary
  std::size_t functions;
  /// Values point by point, `functions` a point; +inf where a function does not exist, never NaN.
  std::function<std::vector<double>(const std::vector<BoxPoint>&)> probe;
  std::vector<double> limit;  ///< by function: at most this is wanted everywhere; inf: anything
  std::vector<double>
      tolerance;            ///< by function: cells are halved until the bound is as near to the greatest value
  bool stop_beyond = true;  ///< end as soon as a limit is passed
};

enum class Outcome {
  within,  ///< every bound is at most its limit
  beyond,  ///< some value is beyond its limit
  open,    ///< neither, with kMostPoints points
};

struct Greatest {
  BoxPoint at{};
  double value = -kInf;  ///< of all points evaluated
  double bound = -kInf;  ///< over the whole box; only when the outcome is not `beyond`, or all of it was covered
};

struct Cover {
  Outcome outcome = Outcome::open;
  std::vector<Greatest> greatest;  ///< by function
  std::size_t points = 0;          ///< evaluated
};

Cover cover(const CoverProblem& problem);

/// How far f may rise above the greatest of three neighbouring points on a line.
double rise_between(double first, double middle, double last);

}  // namespace portrait
