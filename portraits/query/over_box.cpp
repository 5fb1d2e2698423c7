#include "portraits/query/over_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace portrait {
namespace {

/// Gauss-Legendre on 0 .. 1.
constexpr std::array<double, kNodes> kNode = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                              0.953089922969332};
constexpr std::array<double, kNodes> kWeight = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                                0.23931433524968324, 0.11846344252809454};

/// Reports go on until a constraint's bound is this near to its greatest value, relative to the constraint's own bound.
constexpr double kReportTo = 2e-3;

}  // namespace

BoxExaminer::BoxExaminer(const Grid& grid, const PlantBox& box, const PlantTrials& trials)
    : grid_(grid),
      box_(box),
      trials_(trials),
      corners_(box.corners()),
      proof_(box.middles(kProofPlants)),
      nodes_({{0, 0, 0}}),
      weights_({1}) {
  for (const std::size_t k : box.uncertain()) {
    std::vector<BoxPoint> nodes;
    std::vector<double> weights;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      for (std::size_t j = 0; j < kNodes; ++j) {
        nodes.push_back(nodes_[i]);
        nodes.back()[k] = kNode[j];
        weights.push_back(weights_[i] * kWeight[j]);
      }
    nodes_ = nodes;
    weights_ = weights;
  }
}

std::vector<double> BoxExaminer::values(std::span<const Setting> settings, const std::vector<BoxPoint>& points,
                                        int threads) const {
  std::vector<PlantTrials::Trial> trials;
  trials.reserve(settings.size() * points.size());
  for (const Setting& setting : settings)
    for (const BoxPoint& point : points) trials.push_back({setting, box_.at(point)});
  return trials_.values(trials, threads);
}

std::vector<double> BoxExaminer::values(const Setting& setting, const std::vector<BoxPoint>& points,
                                        int threads) const {
  return values(std::span(&setting, 1), points, threads);
}

std::vector<double> BoxExaminer::at_corners(std::span<const Setting> settings, int threads) const {
  return values(settings, corners_, threads);
}

bool BoxExaminer::is_within(const double* values) const {
  for (std::size_t f = 0; f < trials_.functions(); ++f)
    if (values[f] > trials_.limits()[f]) return false;
  return true;
}

std::vector<BoxExaminer::Mean> BoxExaminer::means(std::span<const Setting> settings, int threads) const {
  const std::vector<double> all = values(settings, nodes_, threads);
  std::vector<Mean> means;
  const double* row = all.data();
  for (std::size_t i = 0; i < settings.size(); ++i) {
    Mean mean{0, true};
    for (const double weight : weights_) {
      mean.objective += weight * row[kObjective];
      mean.within = mean.within && is_within(row);
      row += trials_.functions();
    }
    if (!std::isfinite(mean.objective)) mean.objective = kNaN;
    means.push_back(mean);
  }
  return means;
}

CoverProblem BoxExaminer::problem(const Setting& setting, int threads) const {
  return {.directions = box_.uncertain(),
          .functions = trials_.functions(),
          .probe = [this, setting,
                    threads](const std::vector<BoxPoint>& points) { return values(setting, points, threads); },
          .limit = trials_.limits(),
          .tolerance = std::vector<double>(trials_.functions(), kInf)};
}

BoxExaminer::Judged BoxExaminer::judge(const Setting& setting) const {
  const Cover covered = cover(problem(setting, 1));
  Judged judged{covered.outcome, covered.greatest[kObjective].value, covered.points};
  if (judged.outcome != Outcome::within) return judged;
  judged.loops += proof_.size();
  const std::vector<double> proof = values(setting, proof_, 1);
  for (std::size_t i = 0; i < proof_.size(); ++i) {
    const double* row = &proof[i * trials_.functions()];
    judged.worst_objective = std::max(judged.worst_objective, row[kObjective]);
    if (!is_within(row)) judged.outcome = Outcome::beyond;
  }
  return judged;
}

WorstPlant BoxExaminer::worst_of(const Setting& setting, const Greatest& greatest, std::size_t function) const {
  const RealPlant plant = box_.at(greatest.at);
  const PlantTrials::Report there = trials_.report({setting, plant});
  WorstPlant worst{plant, there.objective, kNaN, greatest.value, greatest.bound, kNaN};
  if (function < kFirstConstraint) return worst;
  worst.left = there.left[function - kFirstConstraint];
  worst.right = there.right[function - kFirstConstraint];
  return worst;
}

OverBox BoxExaminer::report(const Setting& setting, int threads) const {
  const std::size_t functions = trials_.functions();
  OverBox over;
  over.setting = setting;
  over.outcome = judge(setting).outcome;
  over.patch = patch_of(grid_, box_, setting);
  const PlantTrials::Report nominal = trials_.report({setting, box_.nominal});
  over.objective_nominal = nominal.objective;
  over.objective_mean = means(std::span(&setting, 1), threads).front().objective;
  CoverProblem fine = problem(setting, threads);
  fine.stop_beyond = false;
  fine.tolerance.assign(functions, kReportTo);
  fine.tolerance[kObjective] = kReportTo * std::max(std::abs(nominal.objective), kTinyBound);
  if (!std::isfinite(fine.tolerance[kObjective])) fine.tolerance[kObjective] = kInf;
  fine.tolerance[kStatus] = kInf;
  if (over.outcome != Outcome::within) fine.limit.assign(functions, kInf);
  Cover covered = cover(fine);
  const std::vector<double> proof = values(setting, proof_, threads);
  std::vector<std::size_t> broken(functions);
  std::size_t any = 0;
  for (std::size_t i = 0; i < proof_.size(); ++i) {
    const double* row = &proof[i * functions];
    any += is_within(row) ? 0 : 1;
    for (std::size_t f = 0; f < functions; ++f) {
      broken[f] += row[f] > trials_.limits()[f] ? 1 : 0;
      if (row[f] > covered.greatest[f].value)
        covered.greatest[f] = {proof_[i], row[f], std::max(row[f], covered.greatest[f].bound)};
    }
  }
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(proof_.size());
  };
  over.objective = worst_of(setting, covered.greatest[kObjective], kObjective);
  for (std::size_t f = kFirstConstraint; f < functions; ++f) {
    over.constraints.push_back(worst_of(setting, covered.greatest[f], f));
    over.constraints.back().share = share(broken[f]);
  }
  over.share = share(any);
  over.right_status = covered.greatest[kStatus].value <= 0;
  over.wrong_status_plant = box_.at(covered.greatest[kStatus].at);
  over.share_wrong_status = share(broken[kStatus]);
  over.Ms_plant = box_.at(covered.greatest[kStability].at);
  if (covered.greatest[kStability].value < 0) over.Ms = -1 / covered.greatest[kStability].value;
  return over;
}

}  // namespace portrait
