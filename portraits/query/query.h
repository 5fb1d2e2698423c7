/// The best settings of a portrait under constraints, exact on the grid.
///
/// A setting is eligible when it is settled (or not_settled, when asked for) and its objective is not NaN,
/// and admissible when every constraint holds besides. With a real plant all measures are in its units, for
/// steps of size one, while parameters keep meaning the normalised values of the grid; of a portrait with an
/// axis tau_1 only the slice tau_1 = T1/Td is asked.
///
/// cost      one pass over the columns in use, kBlockSettings settings at a time, then a read for each answer
/// memory    a column of a block for each quantity in use and each side of a constraint, the values of the axes,
///           the answers, and three columns a level of the deepest expression: never more than 10 MB
/// order     the same answer always: of equal objectives the lower setting number is better
/// accuracy  equal to a plain loop over all settings: tests/portraits/query/query_property_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/loop/real_plant.h"
#include "portraits/column_source.h"
#include "portraits/query/constraint.h"
#include "portraits/query/expression.h"

namespace portrait {

inline constexpr std::size_t kBlockSettings = 4096;
inline constexpr std::size_t kMaxTop = 100'000;

struct Question {
  Expression minimize;
  std::vector<Constraint> where;
  std::size_t top = 1;  ///< 1 .. kMaxTop
  std::optional<RealPlant> plant;
  bool include_not_settled = false;
};

/// One setting with everything the portrait knows of it.
struct Found {
  std::uint64_t number;
  Setting setting;      ///< normalised
  MeasureRow measures;  ///< NaN for those that are not stored or do not exist; real units when a plant was given
  double objective;
  Status status;
};

/// A constraint without which, all others kept, the optimum would be strictly better.
struct ActiveConstraint {
  std::size_t constraint;  ///< index in Question::where
  Found optimum;           ///< the best setting without it; when nothing is admissible, the one it alone excludes
};

struct Violation {
  std::size_t constraint;  ///< index in Question::where
  double left, right;      ///< values of the two sides
  double relative;         ///< distance(left, right): 0 for x < x
};

/// The eligible setting whose largest relative violation is smallest; of equals the lower number.
struct NearMiss {
  Found found;
  std::vector<Violation> violations;  ///< of the constraints that fail, in their order
};

/// Settings that no constraint was asked about, by reason.
struct LeftOut {
  std::uint64_t unstable = 0;
  std::uint64_t not_settled = 0;
  std::uint64_t not_computed = 0;
  std::uint64_t objective_missing = 0;  ///< of right status, but the objective is NaN
};

struct Answer {
  std::vector<Found> top;  ///< best first, at most Question::top
  std::uint64_t admissible = 0;
  std::uint64_t total = 0;  ///< settings asked: all, or those of the plant's slice
  LeftOut left_out;
  std::vector<std::uint64_t> excluded;  ///< by constraint: eligible settings for which it does not hold
  std::vector<ActiveConstraint> active;

  // Only when nothing is admissible:
  std::optional<std::size_t> strictest;  ///< the constraint that excludes most; nothing when none was eligible
  std::optional<NearMiss> near_miss;     ///< nothing when every eligible setting has a NaN in a failing constraint
};

/// Throws InputError for a question that does not fit the portrait: names, grid values, plant, top.
Answer ask(const ColumnSource& source, const Question& question);

}  // namespace portrait
