#include "portraits/query/minimiser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include <Eigen/Dense>

#include "engine/base/check.h"

namespace portrait {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDifference = 2e-4;   ///< of central differences
constexpr double kMargin = 1e-10;      ///< by which a linearised constraint is met, so that the true one is
constexpr double kWorthwhile = 1e-12;  ///< relative: what counts as better
constexpr int kMostSteps = 200;
constexpr int kCorrections = 4;
constexpr int kMostRestarts = 6;

/// minimise gradient . p + p' matrix p / 2 where rows p <= room. With room >= 0 there is a solution: p = 0 will do. A
/// correction asks for less than no room, which need not have one.
struct Quadratic {
  VectorXd gradient;
  MatrixXd matrix;  ///< positive definite
  MatrixXd rows;
  VectorXd room;
};

struct Solution {
  VectorXd step;
  VectorXd multipliers;  ///< by row
};

/// The step that keeps just these rows at their limit, with their multipliers.
std::optional<Solution> with_active(const Quadratic& q, const std::vector<Index>& active) {
  const Index n = q.gradient.size(), m = static_cast<Index>(active.size());
  MatrixXd system = MatrixXd::Zero(n + m, n + m);
  VectorXd right(n + m);
  system.topLeftCorner(n, n) = q.matrix;
  right.head(n) = -q.gradient;
  for (Index k = 0; k < m; ++k) {
    system.block(n + k, 0, 1, n) = q.rows.row(active[static_cast<std::size_t>(k)]);
    system.block(0, n + k, n, 1) = q.rows.row(active[static_cast<std::size_t>(k)]).transpose();
    right(n + k) = q.room(active[static_cast<std::size_t>(k)]);
  }
  const Eigen::FullPivLU<MatrixXd> lu(system);
  if (!lu.isInvertible()) return std::nullopt;
  const VectorXd all = lu.solve(right);
  Solution solution{all.head(n), VectorXd::Zero(q.rows.rows())};
  for (Index k = 0; k < m; ++k) solution.multipliers(active[static_cast<std::size_t>(k)]) = all(n + k);
  return solution;
}

bool is_optimal(const Quadratic& q, const Solution& s) {
  const VectorXd excess = q.rows * s.step - q.room;
  const double scale = 1 + s.multipliers.cwiseAbs().maxCoeff();
  return excess.maxCoeff() <= 1e-11 && s.multipliers.minCoeff() >= -1e-10 * scale;
}

/// Tries every set of at most n rows, the small ones first.
std::optional<Solution> solve(const Quadratic& q) {
  const Index rows = q.rows.rows(), n = q.gradient.size();
  std::vector<Index> active;
  std::optional<Solution> found;
  const std::function<bool(Index, Index)> extend = [&](Index from, Index left) {
    if (left == 0) {
      found = with_active(q, active);
      return found && is_optimal(q, *found);
    }
    for (Index row = from; row + left <= rows; ++row) {
      active.push_back(row);
      if (extend(row + 1, left - 1)) return true;
      active.pop_back();
    }
    return false;
  };
  for (Index size = 0; size <= n; ++size) {
    active.clear();
    if (extend(0, size)) return found;
  }
  return std::nullopt;
}

class Minimiser {
 public:
  explicit Minimiser(const MinimiserProblem& problem)
      : problem_(problem), n_(static_cast<Index>(problem.start.size())) {}

  Minimum run() {
    point_ = Eigen::Map<const VectorXd>(problem_.start.data(), n_);
    here_ = probe(point_);
    PORTRAIT_CHECK(is_admissible(here_));
    Minimum minimum;
    for (int restart = 0; restart <= kMostRestarts; ++restart) {
      minimum.converged = descend();
      if (!poll()) break;
    }
    minimum.point.assign(point_.data(), point_.data() + n_);
    minimum.probe = here_;
    minimum.prices.assign(prices_.data(), prices_.data() + prices_.size());
    minimum.probes = probes_;
    return minimum;
  }

 private:
  static bool is_admissible(const Probe& probe) {
    return std::isfinite(probe.objective) &&
           std::all_of(probe.constraints.begin(), probe.constraints.end(), [](double value) { return value <= 0; });
  }

  std::vector<Probe> probe_all(const std::vector<VectorXd>& points) {
    std::vector<std::vector<double>> rows;
    for (const VectorXd& point : points) rows.emplace_back(point.data(), point.data() + n_);
    probes_ += points.size();
    return problem_.probe(rows);
  }
  Probe probe(const VectorXd& point) { return probe_all({point}).front(); }

  VectorXd bounded(VectorXd point) const {
    for (Index k = 0; k < n_; ++k)
      point(k) = std::clamp(point(k), problem_.low[static_cast<std::size_t>(k)],
                            problem_.high[static_cast<std::size_t>(k)]);
    return point;
  }

  /// Gradients of objective and constraints at the current point; false where a neighbour does not exist.
  bool differentiate() {
    std::vector<VectorXd> points;
    for (Index k = 0; k < n_; ++k)
      for (const double side : {-1.0, 1.0}) {
        VectorXd next = point_;
        next(k) += side * kDifference;
        points.push_back(bounded(next));
      }
    const std::vector<Probe> probes = probe_all(points);
    const auto constraints = static_cast<Index>(here_.constraints.size());
    gradient_.resize(n_);
    jacobian_.resize(constraints, n_);
    for (Index k = 0; k < n_; ++k) {
      const auto below = static_cast<std::size_t>(2 * k), above = below + 1;
      const double apart = points[above](k) - points[below](k);
      gradient_(k) = (probes[above].objective - probes[below].objective) / apart;
      for (Index j = 0; j < constraints; ++j)
        jacobian_(j, k) = (probes[above].constraints[static_cast<std::size_t>(j)] -
                           probes[below].constraints[static_cast<std::size_t>(j)]) /
                          apart;
    }
    return gradient_.allFinite() && jacobian_.allFinite();
  }

  /// The constraints' room as given, then the sides of the trust region and of the bounds.
  Quadratic quadratic(const VectorXd& room) const {
    const Index m = jacobian_.rows();
    Quadratic q{gradient_, matrix_, MatrixXd::Zero(m + 2 * n_, n_), VectorXd::Zero(m + 2 * n_)};
    q.rows.topRows(m) = jacobian_;
    q.room.head(m) = room;
    for (Index k = 0; k < n_; ++k) {
      const auto variable = static_cast<std::size_t>(k);
      q.rows(m + 2 * k, k) = 1;
      q.room(m + 2 * k) = std::min(radius_, problem_.high[variable] - point_(k));
      q.rows(m + 2 * k + 1, k) = -1;
      q.room(m + 2 * k + 1) = std::min(radius_, point_(k) - problem_.low[variable]);
    }
    return q;
  }

  static VectorXd room_of(const Probe& probe) {
    const auto size = static_cast<Index>(probe.constraints.size());
    return -Eigen::Map<const VectorXd>(probe.constraints.data(), size).array() - kMargin;
  }

  struct Trial {
    VectorXd step;
    Probe probe;
    VectorXd multipliers;
  };

  /// A step of the model, led back to the admissible region when it left it.
  std::optional<Trial> trial() {
    std::optional<Solution> solution = solve(quadratic(room_of(here_).cwiseMax(0)));
    for (int correction = 0; solution && correction <= kCorrections; ++correction) {
      const Probe there = probe(bounded(point_ + solution->step));
      if (is_admissible(there)) return Trial{solution->step, there, solution->multipliers};
      if (!std::isfinite(there.objective)) return std::nullopt;
      const VectorXd linear = jacobian_ * solution->step;
      solution = solve(quadratic(room_of(there) + linear));
    }
    return std::nullopt;
  }

  bool is_better(const Probe& probe) const {
    return probe.objective < here_.objective - kWorthwhile * std::abs(here_.objective);
  }

  VectorXd slope_of_lagrangian(const VectorXd& multipliers) const {
    return gradient_ + jacobian_.transpose() * multipliers.head(jacobian_.rows());
  }

  /// Damped, so that the matrix stays positive definite.
  void learn(const VectorXd& step, const VectorXd& change) {
    const VectorXd moved = matrix_ * step;
    const double curvature = step.dot(moved), along = step.dot(change);
    if (!(curvature > 0)) return;
    const double weight = along >= 0.2 * curvature ? 1 : 0.8 * curvature / (curvature - along);
    const VectorXd mixed = weight * change + (1 - weight) * moved;
    matrix_ += mixed * mixed.transpose() / step.dot(mixed) - moved * moved.transpose() / curvature;
  }

  bool descend() {
    radius_ = 1;
    if (!differentiate()) return false;
    matrix_ = MatrixXd::Identity(n_, n_) * std::max(1e-3 * std::abs(here_.objective), gradient_.norm());
    for (int step = 0; step < kMostSteps && radius_ > kLeastStep; ++step) {
      const std::optional<Trial> next = trial();
      if (!next || !is_better(next->probe)) {
        if (next) prices_ = next->multipliers.head(jacobian_.rows());
        radius_ = std::min(0.5 * radius_, next ? 0.7 * next->step.cwiseAbs().maxCoeff() : kInfinity);
        continue;
      }
      const VectorXd before = slope_of_lagrangian(next->multipliers);
      const VectorXd from = point_;
      point_ = bounded(point_ + next->step);
      here_ = next->probe;
      if (!differentiate()) return false;
      learn(point_ - from, slope_of_lagrangian(next->multipliers) - before);
      prices_ = next->multipliers.head(jacobian_.rows());
      radius_ = std::min(4.0, std::max(radius_, 2 * next->step.cwiseAbs().maxCoeff()));
    }
    return radius_ <= kLeastStep;
  }

  /// Whether a better point was found around, which is then the current one.
  bool poll() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<VectorXd> points;
    for (const double radius : {1.0, 0.3, 0.1, 0.01, 0.001})
      for (int i = 0; i < 32; ++i) {
        VectorXd direction(n_);
        for (Index k = 0; k < n_; ++k) direction(k) = normal(random);
        points.push_back(bounded(point_ + radius * direction.normalized()));
      }
    const std::vector<Probe> probes = probe_all(points);
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < probes.size(); ++i) {
      const bool worthwhile = probes[i].objective < here_.objective - 1e-9 * std::abs(here_.objective);
      if (!worthwhile || !is_admissible(probes[i])) continue;
      if (!best || probes[i].objective < probes[*best].objective) best = i;
    }
    if (!best) return false;
    point_ = points[*best];
    here_ = probes[*best];
    return true;
  }

  const MinimiserProblem& problem_;
  Index n_;
  VectorXd point_, gradient_, prices_;
  MatrixXd jacobian_, matrix_;
  Probe here_;
  double radius_ = 1;
  std::size_t probes_ = 0;
};

}  // namespace

Minimum minimise(const MinimiserProblem& problem) {
  PORTRAIT_CHECK(!problem.start.empty() && problem.start.size() <= kMostVariables);
  PORTRAIT_CHECK(problem.low.size() == problem.start.size() && problem.high.size() == problem.start.size());
  return Minimiser(problem).run();
}

}  // namespace portrait
