#include "engine/reference/response.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/loop/parameters.h"
#include "engine/reference/collocation.h"
#include "engine/reference/delay_free.h"
#include "engine/reference/quiet.h"

namespace portrait::reference {
namespace {

/// Lengths of the panels of one dead time, from left to right; their sum is 1.
using Partition = std::vector<double>;

constexpr std::size_t kMostPanels = 400;
constexpr double kLargestResponse = 1e12;
constexpr double kEpsilon = 2.3e-16;

/// Equal panels, cut finer towards the left edge, where the fastest time constant T leaves a layer e^{-t/T}.
Partition first_partition(int least_panels, double fastest) {
  std::vector<double> cuts;
  for (double cut = 2 * fastest; cut < 1; cut = 1.6 * cut + fastest) cuts.push_back(cut);
  for (int i = 1; i <= least_panels; ++i) cuts.push_back(static_cast<double>(i) / least_panels);
  std::sort(cuts.begin(), cuts.end());
  Partition lengths;
  double last = 0;
  for (const double cut : cuts) {
    if (cut - last < 1e-3 * cut) continue;
    lengths.push_back(cut - last);
    last = cut;
  }
  lengths.back() += 1 - last;
  return lengths;
}

Partition halved(const Partition& partition, const std::vector<bool>& coarse) {
  Partition finer;
  for (std::size_t i = 0; i < partition.size(); ++i) {
    const int parts = coarse[i] ? 2 : 1;
    for (int part = 0; part < parts; ++part) finer.push_back(partition[i] / parts);
  }
  return finer;
}

/// One signal over one step: how large it has been, and how far rounding may have moved it.
struct Extent {
  double largest = 0;
  double noise = 0;
};

/// What is simulated: E and F of the chain have a column for each step.
struct Simulated {
  OpenChain chain;
  std::vector<Step> steps;
  std::array<SteadyState, kSteps> at_rest;
  std::string name;  ///< what reproduces it
};

template <typename AnyLoop>
Simulated simulated(const AnyLoop& loop, std::span<const Step> steps, std::string name) {
  Simulated found{open_chain(loop), {steps.begin(), steps.end()}, {}, std::move(name)};
  const Eigen::MatrixXd E = found.chain.E, F = found.chain.F;
  found.chain.E.resize(E.rows(), static_cast<Eigen::Index>(steps.size()));
  found.chain.F.resize(F.rows(), static_cast<Eigen::Index>(steps.size()));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    found.chain.E.col(static_cast<Eigen::Index>(i)) = E.col(steps[i]);
    found.chain.F.col(static_cast<Eigen::Index>(i)) = F.col(steps[i]);
    found.at_rest[steps[i]] = steady_state(loop, steps[i]);
  }
  return found;
}

/// Runs the loop on one fixed partition.
class Run {
 public:
  Run(const Simulated& simulated, const Nodes& nodes, const Partition& partition, double tolerance)
      : chain_(simulated.chain),
        steps_(simulated.steps),
        nodes_(nodes),
        tolerance_(tolerance),
        coarse_(partition.size(), false) {
    for (const double length : partition) panels_.emplace_back(chain_, nodes, length);
    x_ = States::Zero(chain_.states(), columns());
    const PanelValues zero = PanelValues::Zero(nodes.stages() + 1, columns());
    delayed_.assign(partition.size(), {zero, zero});
    for (const Step step : steps_) response_.steps[step].at_rest = simulated.at_rest[step];
  }

  /// One dead time more; false when a panel was too coarse for it.
  bool advance() {
    double start = static_cast<double>(intervals_++);
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      PanelValues outputs[kOutputs];
      auto& [y, y_slope] = delayed_[i];
      panels_[i].advance(y, y_slope, x_, outputs);
      record(i, start, y, outputs);
      start += panels_[i].length();
      y = std::move(outputs[kZ]);
      y_slope = std::move(outputs[kSlope]);
    }
    return std::none_of(coarse_.begin(), coarse_.end(), [](bool coarse) { return coarse; });
  }

  const std::vector<bool>& coarse() const { return coarse_; }
  int intervals() const { return intervals_; }
  bool has_grown_too_large() const { return largest_ > kLargestResponse; }
  const Response& response() const { return response_; }
  std::size_t panels() const { return panels_.size(); }

  Response finished(double horizon, bool quiet) {
    response_.horizon = horizon;
    response_.last_from = std::floor(horizon - 1);  // the whole last dead time
    response_.quiet = quiet;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      StepResponse& found = response_.steps[steps_[i]];
      found.y_noise = extents_[i][kZ].noise;
      found.u_noise = extents_[i][kU].noise;
      cut_off(found.pieces, horizon);
    }
    return std::move(response_);
  }

 private:
  void record(std::size_t panel, double start, const PanelValues& y, const PanelValues outputs[kOutputs]) {
    for (Eigen::Index i = 0; i < columns(); ++i) {
      const Series z = nodes_.to_series * outputs[kZ].col(i), u = nodes_.to_series * outputs[kU].col(i);
      if (is_coarse(z, kZ, i) || is_coarse(u, kU, i)) coarse_[panel] = true;
      const Step step = steps_[static_cast<std::size_t>(i)];
      Series measured = nodes_.to_series * y.col(i);
      if (step == kOutputStep) measured(0) += 1;
      response_.steps[step].pieces.push_back({start, panels_[panel].length(), std::move(measured), u});
    }
  }

  Eigen::Index columns() const { return static_cast<Eigen::Index>(steps_.size()); }

  bool is_coarse(const Series& c, Output output, Eigen::Index step) {
    Extent& extent = extents_[static_cast<std::size_t>(step)][output];
    extent.largest = std::max(extent.largest, bound(c));
    largest_ = std::max(largest_, extent.largest);
    // Solving for all stages at once leaks rounding from every state into every other.
    const double leaked = chain_.C.row(output).cwiseAbs().maxCoeff() * x_.col(step).cwiseAbs().maxCoeff();
    extent.noise = std::max(extent.noise, kEpsilon * std::max(leaked, extent.largest));
    const double allowed = std::max(tolerance_ * extent.largest, 64 * extent.noise);
    return std::abs(c(c.size() - 1)) + std::abs(c(c.size() - 2)) > allowed;
  }

  static void cut_off(std::vector<Piece>& pieces, double horizon) {
    while (!pieces.empty() && pieces.back().start >= horizon) pieces.pop_back();
    Piece& last = pieces.back();
    if (last.start + last.length <= horizon) return;
    const double end = 2 * (horizon - last.start) / last.length - 1;
    last = {last.start, horizon - last.start, restricted(last.y, -1, end), restricted(last.u, -1, end)};
  }

  const OpenChain& chain_;
  std::vector<Step> steps_;
  const Nodes& nodes_;
  double tolerance_;
  std::vector<Panel> panels_;
  std::vector<bool> coarse_;
  States x_;
  std::vector<std::array<PanelValues, kDelayed>> delayed_;  ///< z and z' of the interval before, by panel
  int intervals_ = 0;
  Response response_;
  std::array<std::array<Extent, kOutputs>, kSteps> extents_{};
  double largest_ = 0;
};

/// To the horizon, or until quiet; nothing when a panel was too coarse.
std::optional<Response> run_to(Run& run, Horizon horizon) {
  QuietWatch watch(run.response(), run.panels());
  const double end = horizon.automatic ? kHorizonCap : horizon.dead_times;
  while (run.intervals() < end) {
    if (!run.advance()) return std::nullopt;
    if (run.has_grown_too_large()) return run.finished(std::min<double>(run.intervals(), end), false);
    if (horizon.automatic && watch.is_quiet()) return run.finished(run.intervals(), true);
  }
  return run.finished(end, !horizon.automatic);
}

Response by_steps(const Simulated& simulated, Horizon horizon, const Accuracy& accuracy) {
  PORTRAIT_CHECK(horizon.automatic || horizon.dead_times > 0);
  const Nodes nodes = radau_nodes(accuracy.stages);
  Partition partition = first_partition(accuracy.least_panels, simulated.chain.fastest);
  while (partition.size() <= kMostPanels) {
    Run run(simulated, nodes, partition, accuracy.tolerance);
    if (auto response = run_to(run, horizon)) return *std::move(response);
    partition = halved(partition, run.coarse());
  }
  throw std::runtime_error(
      fmt::format("the reference simulation cannot resolve this loop with {} panels a dead time: {}", kMostPanels,
                  simulated.name));
}

const Piece& piece_at(const StepResponse& response, double t) {
  const auto after = std::upper_bound(response.pieces.begin(), response.pieces.end(), t,
                                      [](double time, const Piece& piece) { return time < piece.start; });
  PORTRAIT_CHECK(after != response.pieces.begin());
  return *(after - 1);
}

double local(const Piece& piece, double t) { return std::min(1.0, 2 * (t - piece.start) / piece.length - 1); }

}  // namespace

Response simulate(const Loop& loop, Horizon horizon, const Accuracy& accuracy, std::span<const Step> steps) {
  return by_steps(simulated(loop, steps, simulate_command(loop)), horizon, accuracy);
}

Response simulate(const GeneralLoop& loop, Horizon horizon, const Accuracy& accuracy, std::span<const Step> steps) {
  if (loop.plant.dead_time == 0) return simulate_without_dead_time(loop, horizon, accuracy, steps);
  PORTRAIT_CHECK_EQ(loop.plant.dead_time, 1.0);
  return by_steps(simulated(loop, steps, "a loop of general transfer functions"), horizon, accuracy);
}

double y_at(const StepResponse& response, double t) {
  const Piece& piece = piece_at(response, t);
  return value(piece.y, local(piece, t));
}

double u_at(const StepResponse& response, double t) {
  const Piece& piece = piece_at(response, t);
  return value(piece.u, local(piece, t));
}

}  // namespace portrait::reference
