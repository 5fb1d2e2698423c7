/// One real controller over a box of plants: whether it keeps every constraint there, and where it comes nearest to breaking
/// each of them.
///
/// bound     of cover.h; `is_accepted` also simulates kProofPlants plants spread evenly over the box
/// mean      over the box, every plant as likely: kNodes Gauss-Legendre nodes for each of K, Td, T1
/// cost      `is_accepted` some hundred loops, `report` some thousand
#pragma once

#include <vector>

#include "portraits/query/cover.h"
#include "portraits/query/plant_trials.h"

namespace portrait {

inline constexpr std::size_t kProofPlants = 1000;
inline constexpr std::size_t kNodes = 5;

/// The worst plant of the box for one constraint, or for the objective.
struct WorstPlant {
  RealPlant plant;
  double left, right;  ///< sides of the constraint there; the objective is `left`
  double relative;     ///< how far beyond the bound, (left - right)/|right| for <=: above 0 it is broken
  double bound;        ///< nowhere in the box is that more than this; of the objective, its own bound
  double share;        ///< part of the box that breaks the constraint, of the proof plants
};

struct OverBox {
  Setting setting;  ///< for the nominal plant
  Outcome outcome = Outcome::open;
  double objective_nominal = kNaN, objective_mean = kNaN;
  WorstPlant objective{};
  std::vector<WorstPlant> constraints;  ///< in their order
  double Ms = kNaN;                     ///< the greatest; NaN when some plant is unstable
  RealPlant Ms_plant;
  bool right_status = false;  ///< of every plant simulated; else an example, and the part of the box
  RealPlant wrong_status_plant;
  double share_wrong_status = 0;
  double share =
      0;  ///< part of the box that breaks some constraint or has not the right status, of the proof plants
  std::vector<Extent> patch;
};

class BoxExaminer {
 public:
  /// REQUIRES: all outlive this.
  BoxExaminer(const Grid& grid, const PlantBox& box, const PlantTrials& trials);

  /// Values at the corners of the box, corner by corner, of many settings.
  std::vector<double> at_corners(std::span<const Setting> settings, int threads) const;
  std::size_t corner_count() const { return corners_.size(); }

  struct Mean {
    double objective;  ///< NaN when it is not finite at some node
    bool within;       ///< no node breaks a limit
  };
  std::vector<Mean> means(std::span<const Setting> settings, int threads) const;

  struct Judged {
    Outcome outcome;
    double worst_objective;
    std::size_t loops;
  };
  Judged judge(const Setting& setting) const;
  OverBox report(const Setting& setting, int threads) const;

 private:
  std::vector<double> values(const Setting& setting, const std::vector<BoxPoint>& points, int threads) const;
  std::vector<double> values(std::span<const Setting> settings, const std::vector<BoxPoint>& points,
                             int threads) const;
  CoverProblem problem(const Setting& setting, int threads) const;
  bool is_within(const double* values) const;
  WorstPlant worst_of(const Setting& setting, const Greatest& greatest, std::size_t function) const;

  const Grid& grid_;
  const PlantBox& box_;
  const PlantTrials& trials_;
  std::vector<BoxPoint> corners_, proof_, nodes_;
  std::vector<double> weights_;  ///< of the nodes
};

}  // namespace portrait
