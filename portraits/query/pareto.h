/// The settings that no other admissible setting beats: the front over two or three expressions, all to be small.
///
/// One setting dominates another when it is at most as large in every expression and smaller in one. Of settings with
/// equal values the lowest number stands for all.
///
/// scale     for knee and subset each expression is scaled to 0 .. 1 over the front
/// knee      the point with the least sum of scaled values: with two expressions the one farthest below the chord from
///           end to end
/// subset    the ends, then always the point farthest from all chosen ones: evenly spread, however dense the front is
/// accuracy  equal to comparing all pairs: tests/portraits/query/kinds_property_test.cpp
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "portraits/query/query.h"

namespace portrait {

inline constexpr std::size_t kMostObjectives = 3;

struct ParetoQuestion {
  std::vector<Expression> minimize;  ///< two or three
  Conditions conditions;
  std::size_t subset = 12;  ///< at most so many points, at least 2
};

struct FrontPoint {
  std::uint64_t number;
  std::array<double, kMostObjectives> values;  ///< of the expressions, 0 beyond them; never NaN
};

struct ParetoAnswer {
  std::vector<FrontPoint> front;    ///< by the first value, then the second, ...
  std::size_t knee = 0;             ///< index in front; 0 when it is empty
  std::vector<std::size_t> subset;  ///< indices in front, increasing
  std::uint64_t admissible = 0, total = 0;
  LeftOut left_out;  ///< objective_missing: NaN in some expression
};

/// Throws InputError for a question that does not fit the portrait.
ParetoAnswer pareto(const ColumnSource& source, const ParetoQuestion& question);

/// Whether a is at most b in every value and smaller in one.
bool dominates(const FrontPoint& a, const FrontPoint& b);

/// REQUIRES: a front, not empty.
std::size_t knee_of(const std::vector<FrontPoint>& front, std::size_t objectives);
std::vector<std::size_t> even_subset(const std::vector<FrontPoint>& front, std::size_t objectives,
                                     std::size_t size);

}  // namespace portrait
