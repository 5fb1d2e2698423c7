/// The closed loops of a pack, a lane each, from t = 0 to the horizon, one dead time after the other.
///
/// On one dead time the measured output y is known from the interval before, so filter, controller and plant are an open
/// chain driven by known series: every block is a tridiagonal solve or an integration in the coefficients (chain.inl). One
/// run gives both responses: with all zero before t = 0 and d = 1, r = 0,
///
///     y_w = g0 int v + g1 v + g2 v'
///     u_w = y_w''(t + 1)  (dipdt),   y_w'(t + 1)  (ipdt),   tau_1 y_w'(t + 1) + y_w(t + 1)  (fotd)
///
/// with g = (kappa/tau_i) (1, b, c) behind the prefilter `full`. Other prefilters that cancel give other g.
#pragma once

#include "engine/kernel/chain.inl"
#include "engine/kernel/setpoint.inl"
#include "engine/kernel/step_meters.inl"

namespace portrait::PORTRAIT_ISA_NAME {

using kernel::Pack;
using kernel::PackResult;
using kernel::PlantKind;
using kernel::SetpointRun;

/// One closed loop per lane: driven by d = 1, which through the identity gives both responses, or by the setpoint alone.
template <PlantKind plant, bool filtered, bool disturbed>
class Run {
 public:
  Run(const Pack& pack, StepMeters& w, StepMeters& d) : pack_(pack), span_(pack.horizon), w_(w), d_(d) { set_up(); }

  /// Feeds the meters of one step, or of both, up to the horizon.
  void to_horizon() {
    // u_w is seen one dead time late.
    const int simulated = span_.intervals + (both_ ? 1 : 0);
    for (int k = 0; k < simulated && any(active_); ++k) {
      if (k == pack_.layered_intervals) leave_layers();
      const bool look = k % 8 == 7;
      quiet_ = active_;
      for (int p = 0; p < panel_count_; ++p) panel(k, p, look);
      dead_times = select(active_, Lanes(k + 1.0), dead_times);
      if (look) rest_when_quiet();
    }
  }

  Lanes dead_times = 0.0;

 private:
  void set_up() {
    both_ = disturbed && pack_.setpoint_run == SetpointRun::from_disturbance;
    if (both_) derived_.begin(pack_);
    if (!disturbed) setpoint_.begin(pack_);
    chain_.begin(pack_, both_ ? derived_.extra(plant) : 0);
    chain_.load = disturbed ? 1.0 : 0.0;
    active_ = Mask::from((1u << kLanes) - 1);
    set_mesh(pack_.mesh);
    for (int p = 0; p < panel_count_; ++p) outputs_[p].begin();
  }

  void set_mesh(const kernel::Mesh& mesh) {
    panel_count_ = panels_of(mesh);
    double lengths[kernel::kMaxPanels];
    cut(mesh, lengths);
    double start = 0;
    for (int p = 0; p < panel_count_; start += lengths[p++]) {
      Panel& panel = panels_[p];
      panel.start = start;
      panel.half = 0.5 * lengths[p];
      panel.weights.prepare(panel.half);
      if (filtered) panel.filter.prepare(Lanes::from(pack_.tau_f), panel.half);
      if (plant == PlantKind::fotd) panel.plant.prepare(Lanes::from(pack_.tau_1), panel.half);
      if (!disturbed) setpoint_.prepare(panel.prefilter, panel.half);
    }
  }

  /// Layers have faded: from here on panels are as long as smooth signals allow.
  void leave_layers() {
    if (pack_.mesh.graded == 0) return;
    // Of the others the chain makes new ones before it looks at them.
    const int derivatives = (filtered ? 1 : 2) + (both_ ? derived_.extra(plant) : 0);
    Flattening(derivatives).flatten(pack_.mesh, outputs_);
    set_mesh({0, pack_.mesh.halved});
  }

  /// Lanes whose signals all stay at rest need no more intervals.
  void rest_when_quiet() {
    if (!any(quiet_)) return;
    if (disturbed) d_.y.finish(quiet_), d_.u.finish(quiet_);
    if (both_ || !disturbed) w_.y.finish(quiet_), w_.u.finish(quiet_);
    active_ = but_not(active_, quiet_);
  }

  void panel(int k, int p, bool look) {
    const Panel& panel = panels_[p];
    Output& z = outputs_[p];
    const bool counts = reaches(k, p);
    const Place at = place(k, p, look);
    if (counts) watch_output(z, at);
    if constexpr (disturbed) {
      chain_.run(panel, {{&z.y, &z.y1, &z.y2, &z.y3}}, z.y1, z);
    } else {
      subtract_setpoint(panel, z);
      chain_.run(panel, {{&error_, filtered ? &error1_ : &z.y1, &z.y2, nullptr}}, error1_, z);
    }
    if (both_) derive_setpoint(k, p, look);
    Series& u = plant_input<plant>(z);
    if (counts)
      watch_signal(disturbed ? d_.u : w_.u, {u, plant_input_slope<plant>(z), Lanes(1.0), chain_.u1_rest}, at,
                   kInputJumps, active_, quiet_);
    if (plant != PlantKind::fotd) u[0] += chain_.load;
  }

  /// h = y - r and h' = y' - r'.
  void subtract_setpoint(const Panel& panel, const Output& z) {
    setpoint_.next(panel.prefilter, panel.half);
    for (int k = 0; k < kTerms; ++k) {
      error_[k] = z.y[k] - setpoint_.r[k];
      error1_[k] = z.y1[k] - setpoint_.r1[k];
    }
  }

  /// y, and e = 0 - y or 1 - y.
  void watch_output(const Output& z, const Place& at) {
    StepMeters& m = disturbed ? d_ : w_;
    watch_signal(m.y, {z.y, z.y1, Lanes(1.0), z.slope_rest}, at, false, active_, quiet_);
    watch_error(m.e, {z.y, Lanes(disturbed ? 0.0 : 1.0), Lanes(-1.0), z.rest, z.sums}, at, active_);
  }

  /// Whether panel p of interval k has a part before the horizon.
  bool reaches(int k, int p) const {
    if (k < 0 || k >= span_.intervals) return false;
    return span_.fraction == 0 || k < span_.intervals - 1 || panels_[p].start < span_.fraction;
  }

  Place place(int k, int p, bool look) const {
    const Panel& panel = panels_[p];
    Place at{k + panel.start + panel.half, panel.half, 1, false, false, false, false, false, false};
    const bool last_interval = k == span_.intervals - 1, cut = last_interval && span_.fraction > 0;
    if (cut && panel.start + 2 * panel.half > span_.fraction)
      at.end = (span_.fraction - panel.start) / panel.half - 1;
    at.first_of_interval = p == 0;
    at.first_of_all = p == 0 && k == 0;
    at.last_of_interval = p == panel_count_ - 1;
    at.last_of_all = last_interval && (cut ? panel.start + 2 * panel.half >= span_.fraction : at.last_of_interval);
    at.late = k >= span_.late_from;
    at.look = look;
    return at;
  }

  /// y_w of this interval, and u_w of the one before.
  void derive_setpoint(int k, int p, bool look) {
    const bool for_y = reaches(k, p), for_u = reaches(k - 1, p);
    if (derived_.is_scaled() && plant != PlantKind::fotd) {
      const Lanes g0 = derived_.scale();
      if (for_y)
        watch_derived_output({chain_.sum, chain_.v, g0, chain_.v_rest}, chain_.sum_rest, chain_.of_sum,
                             place(k, p, look));
      const Series& u = kRelativeDegree == 2 ? chain_.v1 : chain_.v;
      const Series& u1 = kRelativeDegree == 2 ? chain_.v2 : chain_.v1;
      if (for_u)
        watch_derived_input({u, u1, g0, kRelativeDegree == 2 ? chain_.v2_rest : chain_.v1_rest},
                            place(k - 1, p, look));
      return;
    }
    Series &f = scratch_[0], &slope = scratch_[1];
    derived_.set(f, 0, chain_);
    derived_.set(slope, 1, chain_);
    if (for_y)
      watch_derived_output({f, slope, Lanes(1.0), rest_bound(slope, 1)}, rest_bound(f, 1), error_sums_of(f),
                           place(k, p, look));
    if (!for_u) return;
    if constexpr (plant == PlantKind::fotd) {
      const Lanes tau_1 = Lanes::from(pack_.tau_1);
      derived_.set(scratch_[2], 2, chain_);
      add_scaled(f, tau_1, slope);
      add_scaled(slope, tau_1, scratch_[2]);
    } else {
      derived_.set(f, kRelativeDegree, chain_);
      derived_.set(slope, kRelativeDegree + 1, chain_);
    }
    watch_derived_input({f, slope, Lanes(1.0), rest_bound(slope, 1)}, place(k - 1, p, look));
  }

  void watch_derived_output(const Signal& y, Lanes rest, const ErrorSums& sums, const Place& at) {
    watch_signal(w_.y, y, at, false, active_, quiet_);
    watch_error(w_.e, {y.f, Lanes(1.0), -y.scale, rest, sums}, at, active_);
  }

  void watch_derived_input(const Signal& u, const Place& at) {
    watch_signal(w_.u, u, at, kInputJumps, active_, quiet_);
  }

  static constexpr int kRelativeDegree = plant == PlantKind::dipdt ? 2 : plant == PlantKind::ipdt ? 1 : 0;

  /// u jumps after every dead time where an ideal derivative meets a plant that passes jumps on.
  static constexpr bool kInputJumps = !filtered && plant != PlantKind::dipdt;

  const Pack& pack_;
  Span span_;
  StepMeters &w_, &d_;
  bool both_ = false;
  int panel_count_ = 0;
  Mask active_, quiet_;
  Chain<plant, filtered> chain_;
  DerivedSetpoint derived_;
  FilteredSetpoint setpoint_;
  Series error_, error1_, scratch_[3];
  Panel panels_[kernel::kMaxPanels];
  Output outputs_[kernel::kMaxPanels];
};

inline void store_step(StepMeters& m, kernel::StepColumns& c) {
  m.evaluate();
  m.e.iae().to(c.iae), m.e.ise().to(c.ise), m.e.itae().to(c.itae), m.e.itse().to(c.itse);
  m.y.variation().to(c.tv_y), m.y.deviation0().to(c.tv0_y), m.y.deviation1().to(c.tv1_y);
  m.y.deviation2().to(c.tv2_y), m.y.largest().to(c.y_max);
  m.u.variation().to(c.tv_u), m.u.deviation0().to(c.tv0_u), m.u.deviation1().to(c.tv1_u);
  m.u.deviation2().to(c.tv2_u), m.u.largest().to(c.u_max);
}

template <PlantKind plant, bool filtered, bool disturbed>
__attribute__((noinline)) void run_step(const Pack& pack, StepMeters& w, StepMeters& d, Lanes& dead_times) {
  Run<plant, filtered, disturbed> run(pack, w, d);
  run.to_horizon();
  dead_times = max(dead_times, run.dead_times);
}

template <PlantKind plant, bool filtered>
void run_family(const Pack& pack, PackResult& result) {
  Queues queues;
  StepMeters w, d;
  Lanes dead_times = 0.0;
  w.begin(Lanes::from(pack.y_rest_w), Lanes::from(pack.u_rest_w), queues);
  d.begin(Lanes::from(pack.y_rest_d), Lanes::from(pack.u_rest_d), queues);
  run_step<plant, filtered, true>(pack, w, d, dead_times);
  if (pack.setpoint_run != SetpointRun::from_disturbance) run_step<plant, filtered, false>(pack, w, d, dead_times);
  dead_times.to(result.dead_times);
  store_step(w, result.w);
  store_step(d, result.d);
  Lanes late = 0.0, tail = 0.0;
  const ShapeMeter* meters[] = {&w.y, &w.u, &d.y, &d.u};
  for (const ShapeMeter* m : meters) {
    late = max(late, m->late_part());
    tail = max(tail, m->tail_part());
  }
  late.to(result.late);
  tail.to(result.tail);
}

inline void run(const Pack& pack, PackResult& result) {
  const bool filtered = pack.n > 0;
  switch (pack.plant) {
    case PlantKind::dipdt:
      return filtered ? run_family<PlantKind::dipdt, true>(pack, result)
                      : run_family<PlantKind::dipdt, false>(pack, result);
    case PlantKind::ipdt:
      return filtered ? run_family<PlantKind::ipdt, true>(pack, result)
                      : run_family<PlantKind::ipdt, false>(pack, result);
    case PlantKind::fotd:
      return filtered ? run_family<PlantKind::fotd, true>(pack, result)
                      : run_family<PlantKind::fotd, false>(pack, result);
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
