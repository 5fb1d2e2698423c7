/// The best settings of a portrait under constraints, exact on the grid.
///
/// A setting is eligible when it is settled (or not_settled, when asked for), and admissible when every constraint holds
/// and its objective is not NaN. Measures are in the units of the question (query_units.h), so with a real plant the
/// constraints and the objective are transformed before anything is selected; of a portrait with an axis tau_1 only the
/// slice tau_1 = T1/Td is asked.
///
/// cost      columns are read only as needed: tiles whose ranges rule them out, or in, are not (bench/query_rate.cpp)
/// memory    the ranges of the measures in use, a tile of each of them per thread, the answers: never the columns
/// order     the same answer for any number of threads: of equal objectives the lower setting number is better
/// accuracy  equal to a plain loop over all settings: tests/portraits/query/query_property_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "portraits/column_source.h"
#include "portraits/query/constraint.h"
#include "portraits/query/explain_pass.h"
#include "portraits/query/expression.h"
#include "portraits/query/query_units.h"

namespace portrait {

inline constexpr std::size_t kMaxTop = 100'000;

/// Which settings are asked about, and in which units.
struct Conditions {
  std::vector<Constraint> where;
  QueryUnits units;
  bool include_not_settled = false;
  int threads = 0;  ///< 0: as many as the machine has
};

struct Question {
  Expression minimize;
  Conditions conditions;
  std::size_t top = 1;  ///< 1 .. kMaxTop
  bool count_excluded =
      false;  ///< what each constraint excludes, though something is admissible: reads every column in use
};

/// One setting with everything the portrait knows of it.
struct Found {
  std::uint64_t number;
  Setting setting;      ///< normalised
  MeasureRow measures;  ///< NaN for those that are not stored or do not exist; in the question's units
  double objective;
  Status status;
};

/// A constraint without which, all others kept, the optimum would be strictly better.
struct ActiveConstraint {
  std::size_t constraint;  ///< index in Conditions::where
  Found optimum;           ///< the best setting without it; when nothing is admissible, the one it alone excludes

  /// Its price: the least that it must be loosened for a better optimum, and that optimum. Nothing when no such setting
  /// has numbers on both sides.
  struct Loosened {
    Found found;
    double left, right;  ///< values of the two sides there
    double relative;     ///< distance(left, right)
  };
  std::optional<Loosened> loosened;
};

/// The eligible setting whose largest relative violation is smallest; of equals the lower number.
struct NearMiss {
  Found found;
  std::vector<Violation> violations;  ///< of the constraints that fail, in their order
};

struct Answer {
  std::vector<Found> top;  ///< best first, at most Question::top
  std::uint64_t admissible = 0;
  std::uint64_t total = 0;  ///< settings asked: all, or those of the plant's slice
  LeftOut left_out;
  std::vector<ActiveConstraint> active;

  /// By constraint: eligible settings for which it does not hold. Only when nothing is admissible, or when asked for.
  std::vector<std::uint64_t> excluded;

  // Only when nothing is admissible:
  std::optional<std::size_t> strictest;  ///< the constraint that excludes most; nothing when none was eligible
  std::optional<NearMiss> near_miss;     ///< nothing when every eligible setting has a NaN in a failing constraint
};

/// Throws InputError for a question that does not fit the portrait: names, grid values, plant, top.
Answer ask(const ColumnSource& source, const Question& question);

/// Throws InputError when the conditions do not fit the portrait.
void require_answerable(const Conditions& conditions, const Grid& grid);

/// Everything the portrait knows of a setting. REQUIRES: number < setting_count.
Found found_at(const ColumnSource& source, const QueryUnits& units, std::uint64_t number, double objective);

}  // namespace portrait
