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

namespace portrait::kernel {
namespace {

/// Last coefficients of u and y, as a part of the signal, that count as died out.
constexpr double kResolved = 1e-9;
constexpr double kSettlingBand = 0.01;

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

/// The prefilter `pi` cancels the zero of a PI controller, not those of a filtered PID.
bool needs_own_setpoint_run(const LoopFamily& family, const Setting& s) {
  return family.prefilter == Prefilter::pi && family.n >= 1 && has_integral_action(s);
}

double fastest(const LoopFamily& family, const Setting& s, bool own_run) {
  double time = kInf;
  if (family.n >= 1) time = std::min(time, s.tau_f);
  if (family.plant == Plant::fotd) time = std::min(time, s.tau_1);
  if (own_run) time = std::min(time, s.tau_i);
  return time;
}

/// Settings that may lie side by side in a pack.
struct Kind {
  bool own_run;
  Resolution resolution;

  auto key() const {
    return std::tuple(own_run, resolution.mesh.graded, resolution.mesh.halved, resolution.layered_intervals);
  }
};

Kind kind_of(const LoopFamily& family, const Setting& s) {
  const bool own_run = needs_own_setpoint_run(family, s);
  return {own_run, first_resolution({family, s}, fastest(family, s, own_run))};
}

void fill_lane(Pack& pack, std::size_t lane, const Loop& loop) {
  const Setting& s = loop.setting;
  const Gains g = setpoint_gains(loop.family, s);
  const SteadyState w = rest_after_setpoint_step(loop), d = rest_after_disturbance_step(loop);
  const bool own_run = pack.setpoint_run == SetpointRun::lag;
  pack.kappa[lane] = s.kappa;
  pack.integral_gain[lane] = has_integral_action(s) ? s.kappa / s.tau_i : 0;
  pack.delta[lane] = s.delta;
  pack.tau_1[lane] = s.tau_1;
  pack.tau_f[lane] = s.tau_f;
  pack.g0[lane] = g.g0, pack.g1[lane] = g.g1, pack.g2[lane] = g.g2;
  pack.a1[lane] = own_run ? s.tau_i : 1;
  pack.b_r[lane] = own_run ? s.b * s.tau_i : 0;
  pack.y_rest_w[lane] = w.y, pack.u_rest_w[lane] = w.u;
  pack.y_rest_d[lane] = d.y, pack.u_rest_d[lane] = d.u;
}

Pack pack_for(const LoopFamily& family, const Kind& kind, Horizon horizon) {
  Pack pack{};
  pack.plant = static_cast<PlantKind>(family.plant);
  pack.n = family.n;
  pack.setpoint_run = kind.own_run ? SetpointRun::lag : SetpointRun::from_disturbance;
  pack.horizon = horizon.automatic ? kHorizonCap : horizon.dead_times;
  pack.mesh = kind.resolution.mesh;
  pack.layered_intervals = kind.resolution.layered_intervals;
  return pack;
}

struct StepMeasures {
  Measure IAE;
  std::array<Measure, 4> y, u;
  Measure y_max, u_max;
};

constexpr StepMeasures kSetpointMeasures = {Measure::IAE_w,
                                            {Measure::TV_yw, Measure::TV0_yw, Measure::TV1_yw, Measure::TV2_yw},
                                            {Measure::TV_uw, Measure::TV0_uw, Measure::TV1_uw, Measure::TV2_uw},
                                            Measure::y_max_w,
                                            Measure::u_max_w};
constexpr StepMeasures kDisturbanceMeasures = {Measure::IAE_d,
                                               {Measure::TV_yd, Measure::TV0_yd, Measure::TV1_yd, Measure::TV2_yd},
                                               {Measure::TV_ud, Measure::TV0_ud, Measure::TV1_ud, Measure::TV2_ud},
                                               Measure::y_max_d,
                                               Measure::u_max_d};

/// Without integral action an error may remain for ever: then its integrals do not exist.
ErrorIntegrals take(const StepColumns& c, std::size_t lane, bool error_vanishes, const StepMeasures& names,
                    MeasureRow& row) {
  row[names.IAE] = error_vanishes ? c.iae[lane] : kNaN;
  row[names.y[0]] = c.tv_y[lane], row[names.y[1]] = c.tv0_y[lane];
  row[names.y[2]] = c.tv1_y[lane], row[names.y[3]] = c.tv2_y[lane];
  row[names.u[0]] = c.tv_u[lane], row[names.u[1]] = c.tv0_u[lane];
  row[names.u[2]] = c.tv1_u[lane], row[names.u[3]] = c.tv2_u[lane];
  row[names.y_max] = c.y_max[lane], row[names.u_max] = c.u_max[lane];
  if (!error_vanishes) return {kNaN, kNaN, kNaN};
  return {c.ise[lane], c.itae[lane], c.itse[lane]};
}

LaneMeasured measured(const Pack& pack, const PackResult& result, std::size_t lane, bool automatic) {
  LaneMeasured m;
  m.resolved = result.tail[lane] <= kResolved;
  const bool ended_early = result.dead_times[lane] < pack.horizon;
  const bool settled = automatic ? ended_early : result.late[lane] <= kSettlingBand;
  m.status = settled ? Status::settled : Status::not_settled;
  m.w = take(result.w, lane, pack.y_rest_w[lane] == 1, kSetpointMeasures, m.measures);
  m.d = take(result.d, lane, pack.y_rest_d[lane] == 0, kDisturbanceMeasures, m.measures);
  return m;
}

/// A setting still to be measured.
struct Task {
  std::size_t setting;
  Kind kind;
};

class Measurement {
 public:
  Measurement(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
              Horizon horizon, std::span<LaneMeasured> results)
      : implementation_(implementation), family_(family), settings_(settings), horizon_(horizon), results_(results) {
    for (std::size_t i = 0; i < settings.size(); ++i) tasks_.push_back({i, kind_of(family, settings[i])});
  }

  /// Settings of one kind go side by side; those that are not resolved come back on finer panels.
  void run() {
    while (!tasks_.empty()) {
      std::stable_sort(tasks_.begin(), tasks_.end(),
                       [](const Task& a, const Task& b) { return a.kind.key() < b.kind.key(); });
      const std::vector<Task> tasks = std::exchange(tasks_, {});
      for (auto first = tasks.begin(); first != tasks.end();) {
        const auto last = std::find_if(first, tasks.end(),
                                       [&](const Task& t) { return t.kind.key() != first->kind.key(); });
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
    Pack pack = pack_for(family_, tasks.front().kind, horizon_);
    for (std::size_t lane = 0; lane < kMaxLanes; ++lane)
      fill_lane(pack, lane, {family_, settings_[tasks[std::min(lane, tasks.size() - 1)].setting]});
    PackResult result;
    implementation_.run(pack, result);
    for (std::size_t lane = 0; lane < tasks.size(); ++lane) {
      LaneMeasured& m = results_[tasks[lane].setting];
      m = measured(pack, result, lane, horizon_.automatic);
      if (!m.resolved) try_finer(tasks[lane]);
    }
  }

  void try_finer(const Task& task) {
    if (const auto next = finer(task.kind.resolution)) tasks_.push_back({task.setting, {task.kind.own_run, *next}});
  }

  const Implementation& implementation_;
  LoopFamily family_;
  std::span<const Setting> settings_;
  Horizon horizon_;
  std::span<LaneMeasured> results_;
  std::vector<Task> tasks_;
};

}  // namespace

bool kernel_takes(const LoopFamily& family) { return !(family.n == 0 && family.prefilter == Prefilter::full); }

void measure_responses(const Implementation& implementation, const LoopFamily& family,
                       std::span<const Setting> settings, Horizon horizon, std::span<LaneMeasured> results) {
  PORTRAIT_CHECK(kernel_takes(family));
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  Measurement(implementation, family, settings, horizon, results).run();
}

}  // namespace portrait::kernel
