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
      if (k == pack_.smooth_from) begin_smooth();
      k < pack_.smooth_from ? interval<kDegree>(k) : interval<kSmoothDegree>(k);
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
    active_ = Mask::from(kAllLanes);
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

  /// Nothing fast is left: series end at a lower degree.
  void begin_smooth() {
    for (int p = 0; p < panel_count_; ++p) outputs_[p].cut_at(kSmoothDegree);
    chain_.cut_at(kSmoothDegree);
    if (disturbed) d_.begin_smooth();
    if (both_ || !disturbed) w_.begin_smooth();
  }

  template <int degree>
  void interval(int k) {
    const bool look = k % 8 == 7;
    quiet_ = active_;
    for (int p = 0; p < panel_count_; ++p) panel<degree>(k, p, look);
    dead_times = select(active_, Lanes(k + 1.0), dead_times);
    if (look) rest_when_quiet();
  }

  template <int degree>
  void panel(int k, int p, bool look) {
    const Panel& panel = panels_[p];
    Output& z = outputs_[p];
    const bool counts = reaches(k, p);
    const Place at = place(k, p, look);
    if (counts) watch_output<degree>(z, at);
    run_chain<degree>(panel, z, p == 0 && k == (disturbed ? 1 : 0));
    if (both_) derive_setpoint<degree>(k, p, at);
    Series& u = plant_input<plant>(z);
    if (counts)
      watch_signal<degree>(disturbed ? d_.u : w_.u, {u, plant_input_slope<plant>(z), chain_.u1_rest}, at, kInputJumps,
                           active_, quiet_);
    if (plant != PlantKind::fotd) u[0] += chain_.load;
  }

  /// `begins`: up to here the controller saw nothing.
  template <int degree>
  void run_chain(const Panel& panel, Output& z, bool begins) {
    if constexpr (disturbed) {
      const Derivatives h{{&z.y, &z.y1, &z.y2, &z.y3}};
      if (begins) chain_.enter(h);
      chain_.template run<degree>(panel, h, z.y1, z);
    } else {
      subtract_setpoint(panel, z);
      const Derivatives h{{&error_, filtered ? &error1_ : &z.y1, &z.y2, nullptr}};
      if (begins) chain_.enter(h);
      chain_.template run<degree>(panel, h, error1_, z);
    }
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
  template <int degree>
  void watch_output(const Output& z, const Place& at) {
    StepMeters& m = disturbed ? d_ : w_;
    watch_signal<degree>(m.y, {z.y, z.y1, z.slope_rest}, at, false, active_, quiet_);
    watch_error(m.e, {z.y, z.rest, z.sums}, at, active_);
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
  template <int degree>
  void derive_setpoint(int k, int p, const Place& at) {
    const bool for_y = reaches(k, p), for_u = reaches(k - 1, p);
    const bool scaled = derived_.is_scaled();
    if (for_y && scaled) watch_derived_output<degree>(chain_.sum, chain_.v, chain_.v_rest, chain_.sum_rest, chain_.of_sum, at);
    if (for_y && !scaled) derive_output<degree>(at);
    if (!for_u) return;
    const Place before = place(k - 1, p, at.look);
    if (!scaled || plant == PlantKind::fotd) return derive_input<degree>(before);
    const Series& u = kRelativeDegree == 2 ? chain_.v1 : chain_.v;
    const Series& u1 = kRelativeDegree == 2 ? chain_.v2 : chain_.v1;
    watch_derived_input<degree>(u, u1, kRelativeDegree == 2 ? chain_.v2_rest : chain_.v1_rest, before);
  }

  template <int degree>
  void derive_output(const Place& at) {
    Series &y = scratch_[0], &y1 = scratch_[1];
    derived_.set(y, 0, chain_);
    derived_.set(y1, 1, chain_);
    watch_derived_output<degree>(y, y1, rest_bound(y1, 1), rest_bound(y, 1), error_sums_of(y), at);
  }

  template <int degree>
  void derive_input(const Place& at) {
    Series &u = scratch_[0], &u1 = scratch_[1];
    if constexpr (plant == PlantKind::fotd) {
      derive_input_of_lag<degree>(u, u1);
    } else {
      derived_.set(u, kRelativeDegree, chain_);
      derived_.set(u1, kRelativeDegree + 1, chain_);
    }
    watch_derived_input<degree>(u, u1, rest_bound(u1, 1), at);
  }

  /// tau_1 y_w' + y_w and its slope.
  template <int degree>
  void derive_input_of_lag(Series& u, Series& u1) {
    const Lanes tau_1 = Lanes::from(pack_.tau_1);
    if (derived_.is_scaled()) {
      for (int k = 0; k <= degree; ++k) {
        u[k] = mul_add(tau_1, chain_.v[k], chain_.sum[k]);
        u1[k] = mul_add(tau_1, chain_.v1[k], chain_.v[k]);
      }
      return set_zero_above(u, degree), set_zero_above(u1, degree);
    }
    derived_.set(u, 0, chain_);
    derived_.set(u1, 1, chain_);
    derived_.set(scratch_[2], 2, chain_);
    add_scaled(u, tau_1, u1);
    add_scaled(u1, tau_1, scratch_[2]);
  }

  template <int degree>
  void watch_derived_output(const Series& y, const Series& y1, Lanes slope_rest, Lanes rest, const ErrorSums& sums,
                            const Place& at) {
    watch_signal<degree>(w_.y, {y, y1, slope_rest}, at, false, active_, quiet_);
    watch_error(w_.e, {y, rest, sums}, at, active_);
  }

  template <int degree>
  void watch_derived_input(const Series& u, const Series& u1, Lanes slope_rest, const Place& at) {
    watch_signal<degree>(w_.u, {u, u1, slope_rest}, at, kInputJumps, active_, quiet_);
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
  w.begin(Lanes::from(pack.y_rest_w), Lanes::from(pack.u_rest_w), 1, scale_of_setpoint(pack), queues);
  d.begin(Lanes::from(pack.y_rest_d), Lanes::from(pack.u_rest_d), 0, 1.0, queues);
  run_step<plant, filtered, true>(pack, w, d, dead_times);
  if (pack.setpoint_run != SetpointRun::from_disturbance) run_step<plant, filtered, false>(pack, w, d, dead_times);
  dead_times.to(result.dead_times);
  store_step(w, result.w);
  store_step(d, result.d);
  Lanes late = 0.0, tail = 0.0, smooth_tail = 0.0;
  const ShapeMeter* meters[] = {&w.y, &w.u, &d.y, &d.u};
  for (const ShapeMeter* m : meters) {
    late = max(late, m->late_part());
    tail = max(tail, m->tail_part());
    smooth_tail = max(smooth_tail, m->smooth_tail_part());
  }
  late.to(result.late);
  tail.to(result.tail);
  smooth_tail.to(result.smooth_tail);
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
