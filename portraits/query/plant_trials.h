/// What real controllers do on the plants of a box, simulated by the engine: the functions that a robust answer keeps below
/// their limits, and the objective.
///
/// functions 0 the objective, in the question's units
///           1 -1/Ms, below 0 as long as the loop is stable: the Nyquist curve's distance from -1, with its sign
///           2 -1 with the right status (settled), else 1
///           3 .. by constraint, in the question's order: (left - right)/|right| for <=, the negative for >=, but at least
///           kDeepest. A relation between names of the grid alone (delta == 0.35) chose the setting: it is -1 throughout
/// names     measures are those of the real loop with each plant; parameters and values of the controller are those that
///           the controller has on the nominal plant
/// +inf      where a measure or the objective does not exist: all of them when the loop is unstable
/// sampling  of noise_gain stays the same real time on every plant
/// cost      microseconds a loop, as a sweep
#pragma once

#include <span>
#include <vector>

#include "portraits/query/measured.h"
#include "portraits/query/plant_box.h"
#include "portraits/query/query.h"

namespace portrait {

inline constexpr double kDeepest = -1;  ///< how far below its bound a constraint is told apart
inline constexpr std::size_t kObjective = 0, kStability = 1, kStatus = 2, kFirstConstraint = 3;

class PlantTrials {
 public:
  /// The units' plant is not used, but the box's nominal one. REQUIRES: all outlive this; the question fits the grid.
  PlantTrials(const Grid& grid, const PlantBox& box, const Expression& objective, const Conditions& conditions);

  std::size_t functions() const { return kFirstConstraint + conditions_.where.size(); }
  const std::vector<double>& limits() const { return limits_; }

  /// A controller, as its setting for the nominal plant, on another plant.
  struct Trial {
    Setting setting;
    RealPlant plant;
  };
  /// functions() values a trial.
  std::vector<double> values(std::span<const Trial> trials, int threads) const;

  /// Both sides of every constraint, the objective and everything else of one trial.
  struct Report {
    Measured measured;  ///< on that plant
    double objective;
    std::vector<double> left, right;
    double Ms;
  };
  Report report(const Trial& trial) const;

 private:
  struct Ran;
  Ran run(std::span<const Trial> trials) const;
  std::vector<double> values_of(const Ran& ran) const;

  const Grid& grid_;
  const PlantBox& box_;
  const Expression& objective_;
  const Conditions& conditions_;
  std::vector<Quantity> used_;
  std::vector<Measure> measures_;  ///< of them
  std::vector<bool> chooses_;  ///< by constraint: between names of the grid alone
  std::vector<double> limits_;
};

/// Throws InputError for a constraint that no box of plants can keep: == with a measure in it.
void require_keepable(const Constraint& constraint);

}  // namespace portrait
