#include "engine/kernel/responses.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/check.h"
#include "engine/loop/steady_state.h"

namespace portrait::kernel {
namespace {

/// Panels a dead time is cut into, from one attempt to the next.
constexpr std::array<int, 6> kPanelCounts = {1, 2, 4, 8, 16, 24};
/// Last coefficients of u and y, as a part of the signal, that count as died out.
constexpr double kResolved = 1e-8;
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

/// First length of a geometric row of `count` panels that adds up to 1, and their ratio.
struct Row {
  double first, ratio;
};

/// The first panel is 4 T long, over which a layer e^{-t/T} fades to e^{-4}; of more than four panels it takes a smaller
/// share of T.
Row row_of(int count, double T) {
  const double first = std::min(1.0 / count, 4 * T * std::min(1.0, 4.0 / count));
  double low = 1, high = 1e6;
  for (int i = 0; i < 60; ++i) {
    const double ratio = std::sqrt(low * high);
    double sum = 0, length = first;
    for (int p = 0; p < count; ++p, length *= ratio) sum += length;
    (sum < 1 ? low : high) = ratio;
  }
  return {first, low};
}

class PackOfSettings {
 public:
  PackOfSettings(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                 Horizon horizon, bool own_run)
      : family_(family), own_run_(own_run) {
    pack_.plant = static_cast<PlantKind>(family.plant);
    pack_.n = family.n;
    pack_.setpoint_run = own_run ? SetpointRun::lag : SetpointRun::from_disturbance;
    pack_.horizon = horizon.automatic ? kHorizonCap : horizon.dead_times;
    for (int lane = 0; lane < implementation.lanes; ++lane)
      fill(lane, settings[std::min<std::size_t>(static_cast<std::size_t>(lane), settings.size() - 1)]);
  }

  const Pack& cut_into(int panels) {
    pack_.panels = panels;
    for (int lane = 0; lane < kMaxLanes; ++lane) cut_lane(lane, panels);
    return pack_;
  }

 private:
  void fill(int lane, const Setting& s) {
    const Loop loop{family_, s};
    const Gains g = setpoint_gains(family_, s);
    const SteadyState w = rest_after_setpoint_step(loop), d = rest_after_disturbance_step(loop);
    pack_.kappa[lane] = s.kappa;
    pack_.integral_gain[lane] = has_integral_action(s) ? s.kappa / s.tau_i : 0;
    pack_.delta[lane] = s.delta;
    pack_.tau_1[lane] = s.tau_1;
    pack_.tau_f[lane] = s.tau_f;
    pack_.g0[lane] = g.g0, pack_.g1[lane] = g.g1, pack_.g2[lane] = g.g2;
    pack_.a1[lane] = own_run_ ? s.tau_i : 1;
    pack_.b_r[lane] = own_run_ ? s.b * s.tau_i : 0;
    pack_.y_rest_w[lane] = w.y, pack_.u_rest_w[lane] = w.u;
    pack_.y_rest_d[lane] = d.y, pack_.u_rest_d[lane] = d.u;
    fastest_[lane] = fastest(family_, s, own_run_);
  }

  void cut_lane(int lane, int panels) {
    const Row row = row_of(panels, fastest_[lane]);
    double length = row.first, sum = 0;
    for (int p = 0; p < panels; ++p, length *= row.ratio) {
      pack_.panel_length[p][lane] = p == panels - 1 ? 1 - sum : length;
      sum += length;
    }
  }

  LoopFamily family_;
  bool own_run_;
  Pack pack_{};
  std::array<double, kMaxLanes> fastest_{};
};

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

/// All of one kind of setpoint run: takes what is resolved and goes on with the rest on finer panels.
void measure_alike(const Implementation& implementation, const LoopFamily& family,
                   std::span<const Setting> settings, Horizon horizon, bool own_run,
                   std::span<LaneMeasured> results) {
  PackOfSettings pack(implementation, family, settings, horizon, own_run);
  for (const int panels : kPanelCounts) {
    PackResult result;
    const Pack& cut = pack.cut_into(panels);
    implementation.run(cut, result);
    bool all = true;
    for (std::size_t lane = 0; lane < settings.size(); ++lane) {
      if (results[lane].resolved) continue;
      results[lane] = measured(cut, result, lane, horizon.automatic);
      all = all && results[lane].resolved;
    }
    if (all) return;
  }
}

}  // namespace

bool kernel_takes(const LoopFamily& family) { return !(family.n == 0 && family.prefilter == Prefilter::full); }

void measure_responses(const Implementation& implementation, const LoopFamily& family,
                       std::span<const Setting> settings, Horizon horizon, std::span<LaneMeasured> results) {
  PORTRAIT_CHECK(kernel_takes(family));
  PORTRAIT_CHECK(!settings.empty() && settings.size() <= static_cast<std::size_t>(implementation.lanes));
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  for (LaneMeasured& result : results) result = {};
  std::array<std::size_t, kMaxLanes> place{};
  for (const bool own_run : {false, true}) {
    std::array<Setting, kMaxLanes> alike;
    std::array<LaneMeasured, kMaxLanes> found;
    std::size_t count = 0;
    for (std::size_t i = 0; i < settings.size(); ++i)
      if (needs_own_setpoint_run(family, settings[i]) == own_run) alike[count] = settings[i], place[count++] = i;
    if (count == 0) continue;
    measure_alike(implementation, family, {alike.data(), count}, horizon, own_run, {found.data(), count});
    for (std::size_t i = 0; i < count; ++i) results[place[i]] = found[i];
  }
}

}  // namespace portrait::kernel
