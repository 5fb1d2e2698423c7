/// All settings of a portrait as points in the plane of two expressions, and the Pareto front of the admissible ones.
///
/// front     exact: an admissible setting belongs to it when no other is at least as good as in both and better in one,
///           small being good; of equal points the lower number. From the least x to the least y
/// cloud     every eligible setting, or every k-th when there are more than kMostPoints of them
/// unit      those of the conditions
/// cost      one pass over the columns in use, and a search in the front a setting
/// accuracy  front equal to that of all pairs compared: tests/portraits/query/planes_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "portraits/query/query.h"

namespace portrait {

inline constexpr std::uint64_t kMostPoints = 200'000;

struct CloudPoint {
  std::uint64_t number;
  double x, y;
  bool admissible;
};

struct Cloud {
  std::vector<CloudPoint> front, points;
  std::uint64_t admissible = 0;
};

/// Points that are not finite in x and y are left out. Throws InputError when something does not fit the portrait.
Cloud cloud(const ColumnSource& source, const Expression& x, const Expression& y, const Conditions& conditions);

/// An expression at one setting, whose measures are in these units.
/// REQUIRES: require_available(expression, grid, has a plant).
double value_at(const Expression& expression, const Setting& setting, const MeasureRow& measures,
                const QueryUnits& units);

}  // namespace portrait
