/// The best controller for a plant that is known only within bounds: one real controller under which every plant of the
/// box meets every constraint.
///
/// The candidates are the settings of the grid, each the controller it is for the nominal plant. On other plants the same
/// controller has other settings, between the grid's and perhaps beyond; they are simulated, not interpolated.
///
/// rejected  a setting for which some simulated plant of the box breaks a constraint: proof, no estimate
/// accepted  a setting whose constraints stay within their limits over the whole box by the bound of cover.h, and on
///           kProofPlants more plants, evenly spread. That the loop stays stable is bounded as well (1/Ms above 0); that it
///           settles within the horizon is asked of the simulated plants alone
/// open      a setting whose bound decides nothing: counted, never taken
/// objective over the box: the worst (the default), the mean of plants evenly spread over it (kNodes Gauss-Legendre nodes
///           for each of K, Td, T1), or that of the nominal plant
/// result    the same for any number of threads; of equal objectives the lower setting number is better
/// cost      settings in order of their nominal objective, corners of the box first, until no better one can come; the mean
///           looks at every setting that is admissible on the nominal plant
/// accuracy  equal to trying every setting on dense plants: tests/portraits/query/robust_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "portraits/query/over_box.h"

namespace portrait {

enum class Over : std::uint8_t { worst, mean, nominal };
inline constexpr std::array<std::string_view, 3> kOverNames = {"worst", "mean", "nominal"};
constexpr std::string_view to_string(Over over) { return kOverNames[static_cast<std::size_t>(over)]; }
std::optional<Over> over_named(std::string_view name);

struct RobustQuestion {
  Expression minimize;
  Conditions conditions;  ///< units.plant is the box's nominal one
  PlantBox box;
  Over over = Over::worst;
  std::size_t top = 1;
};

struct RobustFound {
  Found nominal;     ///< on the nominal plant, as stored; its objective is that asked for
  OverBox over_box;  ///< everything over the box
};

struct RobustAnswer {
  std::vector<RobustFound> top;        ///< best first
  std::optional<RobustFound> nominal;  ///< the best for the nominal plant alone
  std::uint64_t admissible = 0;        ///< on the nominal plant
  std::uint64_t total = 0;
  LeftOut left_out;
  std::uint64_t examined = 0;            ///< settings that were tried on other plants
  std::uint64_t open = 0;                ///< of them, neither accepted nor rejected
  std::uint64_t loops = 0;               ///< simulated
  std::vector<std::uint64_t> broken_by;  ///< by constraint: settings that it rejected, worst at the corners
  std::uint64_t not_settled = 0;  ///< rejected since some plant is unstable, does not settle or lacks the objective

  /// Only when none was found: of the settings that settle at the corners but break a constraint there the one whose worst
  /// relative violation is least; without such one the best for the nominal plant.
  std::optional<OverBox> nearest;
};

/// Throws InputError for a question that does not fit the portrait, or a box that cannot be.
RobustAnswer ask_robust(const ColumnSource& source, const RobustQuestion& question);

/// One controller, given as its setting for the nominal plant, over the box. Throws as above.
/// REQUIRES: the setting is valid for the grid's family.
OverBox examine(const Grid& grid, const RobustQuestion& question, const Setting& setting);

}  // namespace portrait
