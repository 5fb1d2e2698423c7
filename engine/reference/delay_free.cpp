#include "engine/reference/delay_free.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <Eigen/LU>

#include "engine/base/check.h"
#include "engine/base/matrices.h"
#include "engine/reference/collocation.h"

namespace portrait::reference {
namespace {

constexpr double kEpsilon = 2.3e-16;
constexpr double kLargestResponse = 1e12;
constexpr double kQuiet = 1e-10;
constexpr std::size_t kMostPanels = 200'000;

/// x' = A x + E v, (y, u) = C x + F v; a column of E and F for each step that is simulated.
struct ClosedLoop {
  Eigen::MatrixXd A, E, C, F;
};

/// q = (z, z') stands on both sides: q = C_q x + D_q q + F_q v, where D_q is nilpotent without an algebraic loop.
ClosedLoop closed(const OpenChain& chain, std::span<const Step> steps) {
  const Eigen::MatrixXd D = chain.D.topRows(kDelayed);
  const Eigen::MatrixXd solve = (Eigen::MatrixXd::Identity(kDelayed, kDelayed) - D).inverse();
  const Eigen::MatrixXd q_of_x = solve * chain.C.topRows(kDelayed), q_of_v = solve * chain.F.topRows(kDelayed);
  ClosedLoop loop;
  loop.A = chain.A + chain.B * q_of_x;
  loop.C.resize(2, chain.states());
  loop.C.row(0) = q_of_x.row(kY);
  loop.C.row(1) = chain.C.row(kU) + chain.D.row(kU) * q_of_x;
  const Eigen::MatrixXd E = chain.E + chain.B * q_of_v;
  Eigen::MatrixXd F(2, Eigen::Index{kSteps});
  F.row(0) = q_of_v.row(kY);
  F(0, kOutputStep) += 1;
  F.row(1) = chain.F.row(kU) + chain.D.row(kU) * q_of_v;
  loop.E.resize(E.rows(), static_cast<Eigen::Index>(steps.size()));
  loop.F.resize(2, static_cast<Eigen::Index>(steps.size()));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    loop.E.col(static_cast<Eigen::Index>(i)) = E.col(steps[i]);
    loop.F.col(static_cast<Eigen::Index>(i)) = F.col(steps[i]);
  }
  return loop;
}

/// States in units in which rows and columns of A are about as large: powers of 2, so nothing is rounded. High gains and
/// short filters leave A with entries of 1e9 beside roots of 1e2, and an exponential loses as many digits. [Parlett1969]
void balance(ClosedLoop& loop) {
  bool done = false;
  while (!done) {
    done = true;
    for (Eigen::Index i = 0; i < loop.A.rows(); ++i) {
      const double own = std::abs(loop.A(i, i));
      const double row = loop.A.row(i).cwiseAbs().sum() - own, column = loop.A.col(i).cwiseAbs().sum() - own;
      if (!(row > 0 && column > 0)) continue;
      const double unit = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (unit == 1 || column * unit + row / unit > 0.95 * (row + column)) continue;
      done = false;
      loop.A.row(i) /= unit, loop.E.row(i) /= unit;
      loop.A.col(i) *= unit, loop.C.col(i) *= unit;
    }
  }
}

/// What a panel of one length does: x at its nodes and at its end, from x at its start.
struct Map {
  std::vector<Eigen::MatrixXd> of_x, of_v;  ///< by node, 1 .. s: x(c_i h) - x(0) = of_x x(0) + of_v
};

Map panel_map(const ClosedLoop& loop, const Nodes& nodes, double length) {
  const Eigen::Index n = loop.A.rows(), m = loop.E.cols();
  Eigen::MatrixXd generator = Eigen::MatrixXd::Zero(n + m, n + m);
  generator.topLeftCorner(n, n) = loop.A;
  generator.topRightCorner(n, m) = loop.E;
  Map map;
  for (Eigen::Index i = 1; i < nodes.at.size(); ++i) {
    const Eigen::MatrixXd at = exponential(generator * (length * nodes.at(i)));
    map.of_x.emplace_back(at.topLeftCorner(n, n) - Eigen::MatrixXd::Identity(n, n));
    map.of_v.emplace_back(at.topRightCorner(n, m));
  }
  return map;
}

class DelayFreeRun {
 public:
  DelayFreeRun(const GeneralLoop& loop, const Accuracy& accuracy, std::span<const Step> steps)
      : steps_(steps.begin(), steps.end()), nodes_(radau_nodes(accuracy.stages)), accuracy_(accuracy) {
    const OpenChain chain = open_chain(loop);
    loop_ = closed(chain, steps);
    balance(loop_);
    const Eigen::VectorXcd roots = eigenvalues(loop_.A);
    if (roots.size() > 0) slowest_ = -roots.real().maxCoeff(), fastest_ = 1 / roots.cwiseAbs().maxCoeff();
    x_ = Eigen::MatrixXd::Zero(loop_.A.rows(), columns());
    for (const Step step : steps_) response_.steps[step].at_rest = steady_state(loop, step);
    extents_.assign(steps_.size(), {0, 0});
    integrals_ = extents_;
    largest_state_.assign(steps_.size(), 0);
  }

  Response run(Horizon horizon) {
    const double end = horizon.automatic ? kHorizonCap : horizon.dead_times;
    double time = 0, length = std::min({0.5, end, fastest_}) / accuracy_.least_panels;
    while (time < end) {
      // The last panel ends at the horizon and not one rounding before it.
      if (time + length > end * (1 - 1e-12)) length = end - time;
      const Advance advance = advance_by(time, length);
      if (advance == Advance::too_coarse) {
        length *= 0.5;
        continue;
      }
      time = time + length >= end * (1 - 1e-12) ? end : time + length;
      if (largest_ > kLargestResponse) return finished(time, false);
      if (horizon.automatic && is_quiet()) return finished(time, true);
      if (advance == Advance::could_be_longer) length *= 2;
    }
    return finished(end, !horizon.automatic);
  }

 private:
  enum class Advance { too_coarse, done, could_be_longer };
  using Pair = std::array<double, 2>;  ///< of y and u

  Eigen::Index columns() const { return static_cast<Eigen::Index>(steps_.size()); }

  const Map& map_for(double length) {
    const auto found = maps_.find(length);
    if (found != maps_.end()) return found->second;
    return maps_.emplace(length, panel_map(loop_, nodes_, length)).first->second;
  }

  Advance advance_by(double start, double length) {
    if (length < 1e-14 * (1 + start) || response_.steps[steps_[0]].pieces.size() > kMostPanels)
      throw std::runtime_error("the simulation without dead time cannot resolve this loop");
    const Map& map = map_for(length);
    std::vector<Eigen::MatrixXd> gained;
    for (std::size_t i = 0; i < map.of_x.size(); ++i) gained.push_back(map.of_x[i] * x_ + map.of_v[i]);
    double worst = 0;
    std::vector<std::array<Series, 2>> found;
    for (Eigen::Index k = 0; k < columns(); ++k) {
      largest_state_[static_cast<std::size_t>(k)] =
          x_.col(k).cwiseAbs().maxCoeff() + gained.back().col(k).cwiseAbs().maxCoeff();
      found.push_back({series(gained, k, 0), series(gained, k, 1)});
      for (std::size_t signal = 0; signal < 2; ++signal)
        worst = std::max(worst, roughness(found.back()[signal], static_cast<std::size_t>(k), signal));
    }
    if (worst > 1) return Advance::too_coarse;
    for (std::size_t k = 0; k < steps_.size(); ++k) record(start, length, k, found[k]);
    x_ += gained.back();
    return worst < 1e-4 ? Advance::could_be_longer : Advance::done;
  }

  /// y (0) or u (1) on the panel.
  Series series(const std::vector<Eigen::MatrixXd>& gained, Eigen::Index step, Eigen::Index signal) const {
    Eigen::VectorXd values(nodes_.at.size());
    values(0) = loop_.C.row(signal).dot(x_.col(step)) + loop_.F(signal, step);
    for (std::size_t i = 0; i < gained.size(); ++i)
      values(static_cast<Eigen::Index>(i) + 1) = loop_.C.row(signal).dot(gained[i].col(step));
    return nodes_.to_series * values;
  }

  /// Last coefficients over what is allowed.
  double roughness(const Series& c, std::size_t step, std::size_t signal) {
    const double largest = std::max(extents_[step][signal], bound(c));
    const double allowed = std::max(accuracy_.tolerance * largest, 64 * noise(step, signal, largest));
    return (std::abs(c(c.size() - 1)) + std::abs(c(c.size() - 2))) / allowed;
  }

  /// An exponential leaks rounding from every state into every other.
  double noise(std::size_t step, std::size_t signal, double largest) const {
    const double most = loop_.C.row(static_cast<Eigen::Index>(signal)).cwiseAbs().maxCoeff();
    return kEpsilon * std::max(most * largest_state_[step], largest);
  }

  void record(double start, double length, std::size_t k, const std::array<Series, 2>& found) {
    StepResponse& response = response_.steps[steps_[k]];
    const Pair rest{response.at_rest.y, response.at_rest.u};
    std::array<double*, 2> noises{&response.y_noise, &response.u_noise};
    for (std::size_t signal = 0; signal < 2; ++signal) {
      double& extent = extents_[k][signal];
      extent = std::max(extent, bound(found[signal]));
      largest_ = std::max(largest_, extent);
      *noises[signal] = std::max(*noises[signal], noise(k, signal, extent));
      Series deviation = found[signal];
      deviation(0) -= rest[signal];
      last_deviations_.resize(2 * steps_.size());
      last_deviations_[2 * k + signal] = bound(deviation);
      integrals_[k][signal] += length * bound(deviation);
    }
    response.pieces.push_back({start, length, found[0], found[1]});
  }

  /// What is left, going on as the slowest root decays, is a small part of the integral so far, for every signal.
  bool is_quiet() const {
    for (std::size_t k = 0; k < steps_.size(); ++k)
      for (std::size_t signal = 0; signal < 2; ++signal)
        if (last_deviations_[2 * k + signal] / slowest_ > kQuiet * integrals_[k][signal]) return false;
    return true;
  }

  Response finished(double horizon, bool quiet) {
    response_.horizon = horizon;
    response_.last_from = 0.9 * horizon;
    response_.quiet = quiet;
    return std::move(response_);
  }

  std::vector<Step> steps_;
  Nodes nodes_;
  Accuracy accuracy_;
  ClosedLoop loop_;
  double slowest_ = kInf, fastest_ = kInf;
  Eigen::MatrixXd x_;
  std::map<double, Map> maps_;
  Response response_;
  std::vector<Pair> extents_, integrals_;
  std::vector<double> last_deviations_, largest_state_;
  double largest_ = 0;
};

}  // namespace

Response simulate_without_dead_time(const GeneralLoop& loop, Horizon horizon, const Accuracy& accuracy,
                                    std::span<const Step> steps) {
  PORTRAIT_CHECK(loop.plant.dead_time == 0 && (horizon.automatic || horizon.dead_times > 0) && !steps.empty());
  return DelayFreeRun(loop, accuracy, steps).run(horizon);
}

}  // namespace portrait::reference
