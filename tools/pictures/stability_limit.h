/// The limit of stability in a plane of two parameters, all others held.
///
/// method    roots are counted exactly on the nodes of a grid; where two neighbours differ, the edge between them is
///           halved until the limit lies within 1e-6 of its length. What lies between four stable nodes is not seen.
/// accuracy  against the closed form of ipdt with P control: tests/tools/pictures_test.cpp
#pragma once

#include <cstddef>
#include <vector>

#include "engine/loop/parameters.h"
#include "tools/pictures/map.h"

namespace portrait::pictures {

/// A loop with two of its parameters free.
struct Plane {
  Loop base;
  Parameter x, y;

  /// tau_d last, since it means delta = kappa tau_d.
  Loop at(double x_value, double y_value) const;
};

/// 1 where the loop is stable, -1 where not, NaN where it is no valid loop.
Field stability(const Plane& plane, std::vector<double> x, std::vector<double> y);

/// REQUIRES, for all three: both outlive what they are given to; `field` is stability(plane, ...).
Crossing stability_crossing(const Plane& plane, const Field& field);
std::vector<Outline> stability_limit(const Plane& plane, const Field& field);

struct StabilityPicture {
  std::string title, x_label, y_label;
  std::vector<Mark> marks;
};
Script script(const StabilityPicture& picture, const Plane& plane, const Field& field);

/// `count` values from `from` to `to`, in equal steps or equal ratios.
std::vector<double> spread(double from, double to, std::size_t count, bool log);

}  // namespace portrait::pictures
