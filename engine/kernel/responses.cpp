#include "engine/kernel/responses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/check.h"
#include "engine/kernel/resolution.h"
#include "engine/loop/steady_state.h"
#include "engine/measures/step_measures.h"

namespace portrait::kernel {
namespace {

static_assert(kMaxFilters == kMaxFilterOrder);
static_assert(kMaxGains == kMaxGainOrder + 2);
static_assert(kMaxPlantOrder == portrait::kMaxPlantOrder);

/// Last coefficients of u and y, as a part of the signal, that count as died out.
constexpr double kResolved = 1e-9;

/// Dead times; far below where the filter's second formula is in danger, far above where the first loses digits.
constexpr double kSlowFilter = 0.5;

/// y_w = -(g0 int v + g1 v + g2 v') from the disturbance run's filtered error v.
struct Gains {
  double g0, g1, g2;
};

/// C F Q = (g0/s + g1 + g2 s) Q, where the prefilter's denominator cancels.
Gains setpoint_gains(const LoopFamily& family, const Setting& s) {
  const bool integral = has_integral_action(s);
  const double ki = integral ? s.kappa / s.tau_i : 0;
  const double derivative = family.n == 0 ? 0 : s.delta;
  if (family.prefilter == Prefilter::none) return {ki, s.kappa, derivative};
  if (family.prefilter == Prefilter::full)
    return integral ? Gains{ki, ki * s.b, ki * s.c} : Gains{0, s.kappa, s.kappa * s.b};
  return integral ? Gains{ki, s.kappa * s.b, 0} : Gains{0, s.kappa, derivative};
}

/// `pi` cancels the zero of a PI controller, not those of a filtered PID; `full` not those of a PI controller beside an ideal
/// derivative of y alone.
SetpointRun setpoint_run(const LoopFamily& family, const Setting& s) {
  if (plant_kind(family) == PlantKind::cascade)
    return family.prefilter == Prefilter::full && s.delta > 0 && has_integral_action(s) ? SetpointRun::second_order
                                                                                        : SetpointRun::lag;
  const bool integral = has_integral_action(s);
  if (family.prefilter == Prefilter::pi && family.n >= 1 && integral) return SetpointRun::lag;
  if (family.prefilter == Prefilter::full && family.n == 0 && s.delta > 0)
    return integral ? SetpointRun::second_order : SetpointRun::lag;
  return SetpointRun::from_disturbance;
}

/// (1 + b s + c s^2)/(1 + a1 s + a2 s^2)
struct Ratio {
  double a1, a2, b, c;
};

/// As a lag (1 + s)/(1 + s).
constexpr Ratio kNoPrefilter = {1, 1, 1, 0};

Ratio prefilter_of(const LoopFamily& family, const Setting& s, SetpointRun run) {
  if (run == SetpointRun::from_disturbance) return {1, 1, 0, 0};
  if (run == SetpointRun::second_order) return {s.tau_i, s.tau_i * tau_d(s), s.b, s.c};
  const bool integral = has_integral_action(s), derivative = s.delta > 0;
  if (family.prefilter == Prefilter::none || !(integral || derivative)) return kNoPrefilter;
  if (family.prefilter == Prefilter::pi) return integral ? Ratio{s.tau_i, 1, s.b * s.tau_i, 0} : kNoPrefilter;
  return {integral ? s.tau_i : tau_d(s), 1, s.b, 0};
}

/// The smallest time constant that shapes a response.
double fastest(const LoopFamily& family, const Setting& s, SetpointRun run) {
  double time = kInf;
  if (family.n >= 1) time = std::min(time, s.tau_f);
  if (const PlantLags lags = plant_lags({family, s}); lags.count > 0) time = std::min(time, lags.time);
  const Ratio ratio = prefilter_of(family, s, run);
  if (run == SetpointRun::lag) time = std::min(time, ratio.a1);
  if (run == SetpointRun::second_order) time = std::min({time, ratio.a2 / ratio.a1, std::sqrt(ratio.a2)});
  return time;
}

/// Settings that may lie side by side in a pack.
struct Kind {
  SetpointRun run;
  bool slow_filter;
  int terms;  ///< y_w is g0 int v and so many terms more: how many derivatives of v are asked for depends on it
  double horizon;  ///< dead times; of an automatic one as far as this attempt goes
  Resolution resolution;

  auto key() const {
    return std::tuple(run, slow_filter, terms, horizon, resolution.mesh.graded, resolution.mesh.halved,
                      resolution.layered_intervals, resolution.smooth_from);
  }
};

/// A pack runs until the last of its lanes is at rest: settings that take long wait for others like them.
constexpr std::array kAutomaticHorizons = {64.0, 512.0, kHorizonCap};

double next_automatic_horizon(double last) {
  return *std::upper_bound(kAutomaticHorizons.begin(), kAutomaticHorizons.end(), last);
}

Kind kind_of(const LoopFamily& family, const Setting& s, Horizon horizon) {
  const SetpointRun run = setpoint_run(family, s);
  const Gains g = setpoint_gains(family, s);
  const double dead_times = horizon.automatic ? kAutomaticHorizons.front() : horizon.dead_times;
  const int terms = g.g2 != 0 ? 2 : g.g1 != 0 ? 1 : 0;
  const bool slow_filter = family.n >= 1 && terms > 0 && s.tau_f >= kSlowFilter;
  return {run, slow_filter, terms, dead_times, first_resolution({family, s}, fastest(family, s, run))};
}

void fill_lane(Pack& pack, std::size_t lane, const Loop& loop) {
  const Setting& s = loop.setting;
  const Gains g = setpoint_gains(loop.family, s);
  pack.tau_1[lane] = plant_lags(loop).count > 0 ? plant_lags(loop).time : 1;
  if (pack.plant == PlantKind::cascade) {
    const auto gains = gains_of(loop);
    for (std::size_t k = 0; k < gains.size(); ++k) pack.gains[k][lane] = gains[k];
  }
  const SteadyState w = rest_after_setpoint_step(loop), d = rest_after_disturbance_step(loop);
  const Ratio prefilter = prefilter_of(loop.family, s, pack.setpoint_run);
  pack.kappa[lane] = s.kappa;
  pack.integral_gain[lane] = has_integral_action(s) ? s.kappa / s.tau_i : 0;
  pack.delta[lane] = s.delta;
  pack.tau_f[lane] = s.tau_f;
  pack.g0[lane] = g.g0, pack.g1[lane] = g.g1, pack.g2[lane] = g.g2;
  pack.a1[lane] = prefilter.a1, pack.a2[lane] = prefilter.a2;
  pack.b_r[lane] = prefilter.b, pack.c_r[lane] = prefilter.c;
  pack.y_rest_w[lane] = w.y, pack.u_rest_w[lane] = w.u;
  pack.y_rest_d[lane] = d.y, pack.u_rest_d[lane] = d.u;
}

Pack pack_for(const LoopFamily& family, const Kind& kind) {
  Pack pack{};
  pack.plant = plant_kind(family);
  pack.n = family.n;
  pack.m = has_gains(family) ? family.m : std::min(family.n, 1);
  pack.lags = family.plant == Plant::fotd ? 1 : family.j;
  pack.integrators = integrators(family.plant);
  pack.setpoint_run = kind.run;
  pack.slow_filter = kind.slow_filter;
  pack.horizon = kind.horizon;
  pack.mesh = kind.resolution.mesh;
  pack.layered_intervals = kind.resolution.layered_intervals;
  pack.smooth_from = kind.resolution.smooth_from;
  return pack;
}

/// Without integral action an error may remain for ever: then its integrals do not exist.
void take(const StepColumns& c, std::size_t lane, bool error_vanishes, const StepMeasures& names, MeasureRow& row) {
  if (error_vanishes) {
    row[names.IAE] = c.iae[lane], row[names.ISE] = c.ise[lane];
    row[names.ITAE] = c.itae[lane], row[names.ITSE] = c.itse[lane];
  }
  row[names.of_y[0]] = c.tv_y[lane], row[names.of_y[1]] = c.tv0_y[lane];
  row[names.of_y[2]] = c.tv1_y[lane], row[names.of_y[3]] = c.tv2_y[lane];
  row[names.of_u[0]] = c.tv_u[lane], row[names.of_u[1]] = c.tv0_u[lane];
  row[names.of_u[2]] = c.tv1_u[lane], row[names.of_u[3]] = c.tv2_u[lane];
  row[names.y_max] = c.y_max[lane], row[names.u_max] = c.u_max[lane];
}

void fill(Measured& m, const Pack& pack, const PackResult& result, std::size_t lane, bool automatic) {
  m.resolved = result.tail[lane] <= kResolved && result.smooth_tail[lane] <= kResolved;
  const bool ended_early = result.dead_times[lane] < pack.horizon;
  const bool settled = automatic ? ended_early : result.late[lane] <= kSettlingBand;
  m.status = settled ? Status::settled : Status::not_settled;
  m.horizon = automatic ? result.dead_times[lane] : pack.horizon;
  take(result.w, lane, pack.y_rest_w[lane] == 1, kSetpointMeasures, m.measures);
  take(result.d, lane, pack.y_rest_d[lane] == 0, kDisturbanceMeasures, m.measures);
}

/// A setting still to be measured.
struct Task {
  std::size_t setting;
  Kind kind;
};

class Measurement {
 public:
  Measurement(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
              Horizon horizon, std::span<Measured> results, SampledResponses* samples)
      : implementation_(implementation),
        family_(family),
        settings_(settings),
        horizon_(horizon),
        results_(results),
        samples_(samples) {
    if (samples) rows_.resize(SampledResponses::kSignals * samples->count() * kMaxLanes);
    tasks_.reserve(settings.size());
    for (Measured& m : results) m.measures.clear();
    for (std::size_t i = 0; i < settings.size(); ++i) tasks_.push_back({i, kind_of(family, settings[i], horizon)});
  }

  /// Settings of one kind go side by side; those that are not resolved come back on finer panels.
  void run() {
    while (!tasks_.empty()) {
      const auto in_order = [](const Task& a, const Task& b) { return a.kind.key() < b.kind.key(); };
      if (!std::is_sorted(tasks_.begin(), tasks_.end(), in_order))
        std::stable_sort(tasks_.begin(), tasks_.end(), in_order);
      const std::vector<Task> tasks = std::exchange(tasks_, {});
      for (auto first = tasks.begin(); first != tasks.end();) {
        const auto last =
            std::find_if(first, tasks.end(), [&](const Task& t) { return t.kind.key() != first->kind.key(); });
        run_alike({first, last});
        first = last;
      }
    }
  }

 private:
  void run_alike(std::span<const Task> tasks) {
    const auto lanes = static_cast<std::size_t>(implementation_.lanes);
    for (; !tasks.empty(); tasks = tasks.subspan(std::min(lanes, tasks.size())))
      run_pack(tasks.first(std::min(lanes, tasks.size())));
  }

  void run_pack(std::span<const Task> tasks) {
    Pack pack = pack_for(family_, tasks.front().kind);
    for (std::size_t lane = 0; lane < kMaxLanes; ++lane)
      fill_lane(pack, lane, {family_, settings_[tasks[std::min(lane, tasks.size() - 1)].setting]});
    PackResult result;
    const PackSamples into = rows_of_samples();
    if (samples_) pack.samples = &into;
    implementation_.run(pack, result);
    for (std::size_t lane = 0; lane < tasks.size(); ++lane) take_result(tasks[lane], pack, result, lane);
  }

  void take_result(const Task& task, const Pack& pack, const PackResult& result, std::size_t lane) {
    Measured& m = results_[task.setting];
    fill(m, pack, result, lane, horizon_.automatic);
    if (samples_ && m.resolved) take_samples(task.setting, lane);
    if (!m.resolved)
      try_finer(task, result.tail[lane] <= kResolved);
    else if (horizon_.automatic && m.status == Status::not_settled && pack.horizon < kHorizonCap)
      try_longer(task);
  }

  double* rows_of(int signal) {
    return rows_.data() + static_cast<std::size_t>(signal) * samples_->count() * kMaxLanes;
  }

  PackSamples rows_of_samples() {
    if (!samples_) return {};
    return {samples_->sampling(),           static_cast<int>(samples_->count()), rows_of(SampledResponses::kYw),
            rows_of(SampledResponses::kUw), rows_of(SampledResponses::kYd),      rows_of(SampledResponses::kUd)};
  }

  void take_samples(std::size_t setting, std::size_t lane) {
    for (int signal = 0; signal < SampledResponses::kSignals; ++signal) {
      const std::span<double> to = samples_->of(setting, static_cast<SampledResponses::Signal>(signal));
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = rows_of(signal)[k * kMaxLanes + lane];
    }
  }

  void try_finer(Task task, bool all_but_smooth_part) {
    const std::optional<Resolution> next =
        all_but_smooth_part ? without_smooth_part(task.kind.resolution) : finer(task.kind.resolution);
    if (!next) return;
    task.kind.resolution = *next;
    tasks_.push_back(task);
  }

  void try_longer(Task task) {
    task.kind.horizon = next_automatic_horizon(task.kind.horizon);
    tasks_.push_back(task);
  }

  const Implementation& implementation_;
  LoopFamily family_;
  std::span<const Setting> settings_;
  Horizon horizon_;
  std::span<Measured> results_;
  std::vector<Task> tasks_;
  SampledResponses* samples_;
  std::vector<double> rows_;  ///< of a pack
};

}  // namespace

void measure_responses(const Implementation& implementation, const LoopFamily& family,
                       std::span<const Setting> settings, Horizon horizon, std::span<Measured> results,
                       SampledResponses* samples) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  PORTRAIT_CHECK(!samples || !horizon.automatic);
  Measurement(implementation, family, settings, horizon, results, samples).run();
}

}  // namespace portrait::kernel
