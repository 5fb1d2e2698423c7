/// From the best setting of the grid to the best between its points, with the engine, constraints kept.
///
/// Every axis of the grid is free to move between its ends, but for one that a constraint fixes (delta == 0.35), one of a
/// single finite value, and tau_i where the start is at inf. The optimum is local: the one that the grid's best leads to.
///
/// accuracy  1e-6 of the objective: tests/portraits/query/refine_test.cpp
/// cost      some hundred settings measured
#pragma once

#include <optional>
#include <vector>

#include "portraits/query/measured.h"
#include "portraits/query/query.h"

namespace portrait {

/// A grid whose optimum is off by more than this part of the objective is too coarse there, unless told otherwise.
inline constexpr double kCoarseFrom = 0.05;

struct Refined {
  Measured start;  ///< the grid's setting, measured again
  Measured best;   ///< meets every constraint
  double start_objective = 0, objective = 0;
  std::vector<Parameter> moved;     ///< those that were free
  std::vector<Parameter> at_edge;   ///< free ones that ended at an end of their axis: better may lie beyond
  std::vector<double> prices;       ///< by constraint: gain of the objective per unit that its bound is loosened
  std::vector<double> left, right;  ///< by constraint: its sides at the best
  std::size_t settings_measured = 0;
  bool converged = false;

  /// What the optimum between the points is better by, relative to the grid's.
  double gain() const;
};

/// REQUIRES: `from` is admissible under the question. Throws InputError for a constraint with == that is not an axis and
/// its value: no interior is left to move in.
Refined refine(const Grid& grid, const Expression& minimize, const Conditions& conditions, const Setting& from);

/// Axes on whose first or last value the setting lies, where better may lie beyond: not those of one value, nor an end at
/// inf.
std::vector<Parameter> edges_at(const Grid& grid, const Setting& setting);

}  // namespace portrait
