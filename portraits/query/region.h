/// The admissible settings as a region of the grid: how large it is, where it lies, what shape it has; and how a given
/// setting stands to it.
///
/// accuracy  equal to plain loops over all settings: tests/portraits/query/kinds_property_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "portraits/query/measured.h"
#include "portraits/query/pieces.h"
#include "portraits/query/query.h"

namespace portrait {

struct AxisExtent {
  Parameter parameter;
  std::vector<std::uint64_t> counts;       ///< admissible settings by value of the axis
  std::optional<std::size_t> first, last;  ///< indices of the outermost admissible values; nothing when none is
  /// Whether the region goes on where the grid ends. An axis of one value, or one that ends in inf there, has no edge.
  bool at_lower_edge = false, at_upper_edge = false;
};

struct Region {
  std::uint64_t admissible = 0, total = 0;
  LeftOut left_out;
  std::vector<AxisExtent> axes;  ///< those of the grid
  /// How positions along two axes go together over the region, -1 .. 1: along a ridge, far from 0. NaN where one of them
  /// does not vary. Row-major, axes x axes.
  std::vector<double> correlation;
  std::vector<Piece> pieces;  ///< the largest first
};

/// Throws InputError when the conditions do not fit.
Region region(const ColumnSource& source, const Conditions& conditions);

/// Where a value lies on an axis: 0 at its first value, 1 at its last, linear in the index between and beyond. An infinite
/// value is the last when the axis ends in inf, else infinitely far.
double place_on(const Axis& axis, double value);

struct NearestAdmissible {
  Found found;
  double distance;  ///< root of the sum of squares of the differences of places on the axes
};

/// The admissible setting of the grid nearest to a setting; of equals the lower number. Nothing when none is admissible.
std::optional<NearestAdmissible> nearest_admissible(const ColumnSource& source, const Conditions& conditions,
                                                    const Setting& setting);

/// A setting, on the grid or not, against the conditions: measured by the engine, constraint by constraint.
struct Verdict {
  Measured measured;
  bool right_status = false;
  struct Side {
    double left, right;
    bool holds;
    double relative;  ///< distance(left, right)
  };
  std::vector<Side> constraints;  ///< in their order
  bool admissible() const;
};
/// REQUIRES: the setting is valid for the grid's family. Throws InputError when the conditions do not fit.
Verdict judge(const Grid& grid, const Conditions& conditions, const Setting& setting);

}  // namespace portrait
