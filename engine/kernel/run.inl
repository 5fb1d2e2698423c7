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
///
/// A panel of interval k thus gives u_d and y_w of interval k, u_w of the one before, y_d of the one after: it is first
/// advanced, then watched.
#pragma once

#include "engine/kernel/cascade.inl"
#include "engine/kernel/sampler.inl"
#include "engine/kernel/setpoint.inl"
#include "engine/kernel/step_meters.inl"

namespace portrait::PORTRAIT_ISA_NAME {

using kernel::Pack;
using kernel::PackResult;
using kernel::PlantKind;
using kernel::SetpointRun;

/// Of y or u after w or d. REQUIRES: the pack has samples.
inline Sampler sampler_of(const Pack& pack, bool of_w, bool of_y) {
  const kernel::PackSamples& s = *pack.samples;
  double* const to = of_w ? (of_y ? s.y_w : s.u_w) : (of_y ? s.y_d : s.u_d);
  const double* const rest = of_w ? (of_y ? pack.y_rest_w : pack.u_rest_w) : (of_y ? pack.y_rest_d : pack.u_rest_d);
  return {s, to, of_w ? scale_of_setpoint(pack) : Lanes(1.0), Lanes::from(rest)};
}

/// Before the first dead time has passed the plant is at rest, and after d the controller too.
inline void begin_samples(const Pack& pack) {
  sampler_of(pack, true, true).begin(1), sampler_of(pack, true, false).begin(0);
  sampler_of(pack, false, true).begin(1), sampler_of(pack, false, false).begin(1);
}

/// One closed loop per lane: driven by d = 1, which through the identity gives both responses, or by the setpoint alone.
template <PlantKind plant, bool filtered, bool disturbed>
class Run {
 public:
  Run(const Pack& pack, StepMeters& w, StepMeters& d) : pack_(pack), span_(pack.horizon), w_(w), d_(d) {
    both_ = disturbed && pack.setpoint_run == SetpointRun::from_disturbance;
    if (both_) derived_.begin(pack);
    if (!disturbed) setpoint_.begin(pack);
    chain_.begin(pack, both_ ? derived_.extra(plant) : 0, !both_ || derived_.is_scaled());
    chain_.load = disturbed ? 1.0 : 0.0;
    active_ = quiet_ = Mask::from(kAllLanes);
    set_mesh(pack.mesh);
    if (sees_nothing_at_first()) return;
    for (int p = 0; p < panel_count_; ++p) outputs_[p].begin();
    for (int p = 0; p < panel_count_; ++p) watch_output<kDegree>(0, p, false);
  }

  /// Feeds the meters of one step, or of both, up to the horizon.
  void to_horizon() {
    // u_w is seen one dead time late; an instant at the horizon belongs to the dead time after it.
    const int simulated = span_.intervals + (both_ ? 1 : 0) + (pack_.samples ? 1 : 0);
    if (sees_nothing_at_first()) first_interval();
    for (int k = sees_nothing_at_first() ? 1 : 0; k < simulated && any(active_); ++k) {
      if (k == pack_.layered_intervals) leave_layers();
      if (k == pack_.smooth_from) begin_smooth();
      k < pack_.smooth_from ? interval<kDegree>(k) : interval<kSmoothDegree>(k);
    }
  }

  Lanes dead_times = 0.0;

 private:
  static constexpr int kRelativeDegree = plant == PlantKind::dipdt ? 2 : plant == PlantKind::ipdt ? 1 : 0;

  /// u jumps after every dead time where an ideal derivative meets a plant that passes jumps on.
  static constexpr bool kInputJumps = !filtered && plant != PlantKind::dipdt && plant != PlantKind::cascade;

  /// The others have u + d among the derivatives of y.
  static constexpr bool kOwnInput = plant == PlantKind::fotd || plant == PlantKind::cascade;

  /// Whether it is asked after this interval which lanes are at rest.
  static bool looks(int k) { return k % 8 == 7; }

  /// On the first dead time of a run that d drives the controller is at rest, and of all meters only two have something to
  /// do.
  bool sees_nothing_at_first() const { return disturbed && span_.late_from > 1; }

  /// On the second dead time the controller sees the plant's answer to a step: y and y' are positive, and so are, behind the
  /// lags of the filter, v and v'; with an integrator in the plant also y'' and v''. No gain is negative. A cascade's controller
  /// may have higher derivatives, and negative gains.
  Course course_of_derived(int k) const {
    const bool rises = disturbed && both_ && derived_.is_scaled() && k == 1;
    return rises ? Course::rises : Course::open;
  }
  Course course_of_input(int k) const { return disturbed && !kOwnInput && k == 1 ? Course::falls : Course::open; }
  /// One dead time before.
  Course course_of_output(int k) const { return disturbed && k == 1 ? Course::rises : Course::open; }

  StepMeters& own() { return disturbed ? d_ : w_; }

  void set_mesh(const kernel::Mesh& mesh) {
    panel_count_ = panels_of(mesh);
    double lengths[kernel::kMaxPanels];
    cut(mesh, lengths);
    double start = 0;
    for (int p = 0; p < panel_count_; start += lengths[p++]) {
      Panel& panel = panels_[p];
      panel.start = start;
      if (!disturbed) setpoint_.prepare(prefilters_[p], 0.5 * lengths[p]);
      if (p > 0 && lengths[p] == lengths[p - 1])
        panel.solve_as(panels_[p - 1], filtered, kOwnInput);
      else
        prepare(panel, 0.5 * lengths[p]);
    }
  }

  void prepare(Panel& panel, double half) {
    panel.half = half;
    panel.weights.prepare(half);
    if (filtered) panel.filter.prepare(Lanes::from(pack_.tau_f), half);
    if (kOwnInput) panel.plant.prepare(Lanes::from(pack_.tau_1), half);
  }

  /// Layers have faded: from here on panels are as long as smooth signals allow.
  void leave_layers() {
    if (pack_.mesh.graded == 0) return;
    // Of the others the chain makes new ones before it looks at them.
    const int derivatives = (filtered ? 1 : 2) + (both_ ? derived_.extra(plant) : 0);
    Flattening(derivatives).flatten(pack_.mesh, outputs_);
    set_mesh({0, pack_.mesh.halved});
    chain_.forget_ahead();
  }

  /// Nothing fast is left: series end at a lower degree.
  void begin_smooth() {
    for (int p = 0; p < panel_count_; ++p) outputs_[p].cut_at(kSmoothDegree);
    chain_.cut_at(kSmoothDegree);
    own().begin_smooth();
    if (both_) w_.begin_smooth();
  }

  /// Lanes whose signals all stay at rest need no more intervals.
  void rest_when_quiet() {
    if (!any(quiet_)) return;
    if (disturbed) d_.y.finish(quiet_), d_.u.finish(quiet_);
    if (both_ || !disturbed) w_.y.finish(quiet_), w_.u.finish(quiet_);
    active_ = but_not(active_, quiet_);
  }

  /// y_w is still 0, y_d begins.
  void first_interval() {
    for (int p = 0; p < panel_count_; ++p) {
      chain_.run_plant_alone(panels_[p], outputs_[p]);
      watch_output<kDegree>(1, p, false);
      if (pack_.samples) sample_output<kDegree>(0, p);
      const double half = panels_[p].half;
      if (both_) w_.e.template watch<kDegree>({chain_.sum, Lanes(0.0), chain_.of_sum}, panels_[p].start + half, half, active_);
    }
    dead_times = Lanes(1.0);
  }

  template <int degree>
  void interval(int k) {
    quiet_ = active_;
    for (int p = 0; p < panel_count_; ++p) {
      advance<degree>(k, p);
      watch<degree>(k, p);
      if (pack_.samples) sample<degree>(k, p);
    }
    dead_times = select(active_, Lanes(k + 1.0), dead_times);
    if (looks(k)) rest_when_quiet();
  }

  template <int degree>
  __attribute__((noinline)) void advance(int k, int p) {
    Output& z = outputs_[p];
    run_chain<degree>(panels_[p], p, z, p == 0 && k == (disturbed ? 1 : 0));
    Series& u = plant_input<plant>(z);
    input_mean_ = u[0];
    if (!kOwnInput) u[0] += chain_.load;
    if (both_ && !derived_.is_scaled()) derive_output();
    if (both_ && (plant == PlantKind::fotd || !derived_.is_scaled())) derive_input<degree>();
    if (!disturbed) return;
    const int next = p + 1 < panel_count_ ? p + 1 : 0;
    chain_.template run_ahead<degree>(panels_[next], measured(outputs_[next]));
  }

  template <int degree>
  __attribute__((noinline)) void watch(int k, int p) {
    if (!kInputJumps && k >= 2 && k + 1 < span_.late_from) return watch_inside<degree>(k, p);
    chain_.template complete_input<degree>(panels_[p], outputs_[p]);
    watch_output<degree>(k + 1, p, looks(k));
    if (both_) {
      watch_signal_of<degree>(w_.y, derived_output_signal(), k, p, looks(k), false, course_of_derived(k));
      watch_error_of<degree>(w_.e, derived_error(), k, p);
      watch_signal_of<degree>(w_.u, derived_input_signal(), k - 1, p, looks(k), kInputJumps, course_of_derived(k));
    }
    watch_signal_of<degree>(own().u, input_signal(p), k, p, looks(k), kInputJumps, course_of_input(k));
  }

  /// `begins`: up to here the controller saw nothing.
  template <int degree>
  void run_chain(const Panel& panel, int p, Output& z, bool begins) {
    if constexpr (disturbed) {
      const Derivatives h = measured(z);
      if (begins) chain_.enter(h);
      chain_.template run<degree>(panel, h, z.y1, z);
    } else {
      subtract_setpoint(panel, p, z);
      const Derivatives h{{&error_, filtered ? &error1_ : &z.y1, &z.y2, nullptr}};
      if (begins) chain_.enter(h);
      chain_.template run<degree>(panel, h, error1_, z);
    }
  }

  /// The controller's h in a run that d drives.
  static Derivatives measured(const Output& z) { return {{&z.y, &z.y1, &z.y2, &z.y3}}; }

  /// h = y - r and h' = y' - r'.
  void subtract_setpoint(const Panel& panel, int p, const Output& z) {
    setpoint_.next(prefilters_[p], panel.half);
    for (int k = 0; k < kTerms; ++k) {
      error_[k] = z.y[k] - setpoint_.r[k];
      error1_[k] = z.y1[k] - setpoint_.r1[k];
    }
  }

  void derive_output() {
    derived_.set(y_, 0, chain_);
    derived_.set(y1_, 1, chain_);
    y_rest_ = rest_bound(y_, 1), y1_rest_ = rest_bound(y1_, 1);
    y_sums_ = error_sums_of(y_);
  }

  template <int degree>
  void derive_input() {
    if constexpr (plant == PlantKind::fotd) {
      derive_input_of_lag<degree>();
    } else {
      derived_.set(u_, kRelativeDegree, chain_);
      derived_.set(u1_, kRelativeDegree + 1, chain_);
    }
    u1_rest_ = rest_bound(u1_, 1);
  }

  /// tau_1 y_w' + y_w and its slope.
  template <int degree>
  void derive_input_of_lag() {
    const Lanes tau_1 = Lanes::from(pack_.tau_1);
    if (derived_.is_scaled()) {
      for (int k = 0; k <= degree; ++k) {
        u_[k] = mul_add(tau_1, chain_.v[k], chain_.sum[k]);
        u1_[k] = mul_add(tau_1, chain_.v1[k], chain_.v[k]);
      }
      return set_zero_above(u_, degree), set_zero_above(u1_, degree);
    }
    derived_.set(y2_, 2, chain_);
    copy(u_, y_), copy(u1_, y1_);
    add_scaled(u_, tau_1, y1_);
    add_scaled(u1_, tau_1, y2_);
  }

  /// The instants of all signals that the panel gives.
  template <int degree>
  __attribute__((noinline)) void sample(int k, int p) {
    const double start = panels_[p].start, half = panels_[p].half;
    chain_.template complete_input<degree>(panels_[p], outputs_[p]);
    sample_output<degree>(k, p);
    sampler(!disturbed, false).template take<degree>(input_signal(p), k + start, half, active_);
    if (!both_) return;
    sampler(true, true).template take<degree>(derived_output_signal(), k + start, half, active_);
    if (k > 0) sampler(true, false).template take<degree>(derived_input_signal(), k - 1 + start, half, active_);
  }
  template <int degree>
  void sample_output(int k, int p) {
    sampler(!disturbed, true)
        .template take<degree>(output_signal(p), k + 1 + panels_[p].start, panels_[p].half, active_);
  }
  Sampler sampler(bool of_w, bool of_y) const { return sampler_of(pack_, of_w, of_y); }

  /// Once layers have faded the ends of series get smaller from one dead time to the next: then they are watched where the
  /// degree falls, and where it is asked which lanes are at rest.
  bool watches_ends(int k) const {
    return k < 8 || k <= pack_.layered_intervals || k == pack_.smooth_from || looks(k);
  }

  /// A panel inside the response, where no meter does anything but watch.
  template <int degree>
  void watch_inside(int k, int p) {
    const double half = panels_[p].half, middle = k + panels_[p].start + half;
    const unsigned on = bits(active_);
    StepMeters& m = own();
    if (both_) watch_derived_inside<degree>(k, panels_[p], middle, on);
    const Signal y = output_signal(p), u = input_signal(p);
    const Error e = output_error(p);
    const auto y_seen = m.y.see(y, active_), u_seen = m.u.see(u, active_);
    if (watches_ends(k)) m.y.template see_end<degree>(y, active_), m.u.template see_end<degree>(u, active_);
    const unsigned e_open = m.e.see(e, middle + 1, half, active_);
    if (!m.u.goes_on(u_seen, on)) {
      chain_.template complete_input<degree>(panels_[p], outputs_[p]);
      m.u.take_in(u_seen, u, half, on);
    }
    if (!(m.y.goes_on(y_seen, on) & (e_open == 0))) {
      m.y.take_in(y_seen, y, half, on);
      if (e_open != 0) m.e.template look_at<degree>(e_open, e, middle + 1, half);
    }
    if (looks(k)) look_for_rest<degree>(p);
  }

  /// Lanes leave `quiet_` in which a signal moves on this panel. Most do by the mean alone of the first.
  template <int degree>
  __attribute__((noinline)) void look_for_rest(int p) {
    ShapeMeter* const meters[] = {&own().y, &own().u, &w_.y, &w_.u};
    const Signal signals[] = {output_signal(p), input_signal(p), derived_output_signal(), derived_input_signal()};
    const int count = both_ ? 4 : 2;
    for (int i = 0; i < count; ++i) {
      meters[i]->see_size(signals[i], active_);
      quiet_ = quiet_ & meters[i]->may_be_quiet(signals[i], kQuiet);
    }
    if (!any(quiet_)) return;
    chain_.template complete_input<degree>(panels_[p], outputs_[p]);
    for (int i = 0; i < count; ++i) {
      quiet_ = quiet_ & meters[i]->is_quiet(signals[i], kQuiet);
      if (p + 1 == panel_count_) meters[i]->pass(signals[i].end(), active_);
    }
  }

  template <int degree>
  void watch_derived_inside(int k, const Panel& panel, double middle, unsigned on) {
    const Signal y = derived_output_signal(), u = derived_input_signal();
    const Error e = derived_error();
    const auto y_seen = w_.y.see(y, active_), u_seen = w_.u.see(u, active_);
    if (watches_ends(k)) w_.y.template see_end<degree>(y, active_), w_.u.template see_end<degree>(u, active_);
    const unsigned e_open = w_.e.see(e, middle, panel.half, active_);
    if (w_.y.goes_on(y_seen, on) & w_.u.goes_on(u_seen, on) & (e_open == 0)) return;
    chain_.template complete_sum<degree>(panel);
    w_.y.take_in(y_seen, y, panel.half, on);
    w_.u.take_in(u_seen, u, panel.half, on);
    if (e_open != 0) w_.e.template look_at<degree>(e_open, e, middle, panel.half);
  }

  Signal output_signal(int p) const {
    const Output& z = outputs_[p];
    return {z.y, z.y1, z.y[0], z.slope_rest};
  }
  Error output_error(int p) const { return {outputs_[p].y, outputs_[p].rest, outputs_[p].sums}; }
  Signal input_signal(int p) {
    Output& z = outputs_[p];
    return {plant_input<plant>(z), plant_input_slope<plant>(z), input_mean_, chain_.u1_rest};
  }

  Signal derived_output_signal() const {
    if (derived_.is_scaled()) return {chain_.sum, chain_.v, chain_.sum[0], chain_.v_rest};
    return {y_, y1_, y_[0], y1_rest_};
  }
  Error derived_error() const {
    if (derived_.is_scaled()) return {chain_.sum, chain_.sum_rest, chain_.of_sum};
    return {y_, y_rest_, y_sums_};
  }
  Signal derived_input_signal() const {
    if (plant == PlantKind::fotd || !derived_.is_scaled()) return {u_, u1_, u_[0], u1_rest_};
    if (kRelativeDegree == 2) return {chain_.v1, chain_.v2, chain_.v1[0], chain_.v2_rest};
    return {chain_.v, chain_.v1, chain_.v[0], chain_.v1_rest};
  }

  /// y, and e = 0 - y or 1 - y.
  template <int degree>
  void watch_output(int k, int p, bool look) {
    watch_signal_of<degree>(own().y, output_signal(p), k, p, look, false, course_of_output(k));
    watch_error_of<degree>(own().e, output_error(p), k, p);
  }

  template <int degree>
  void watch_signal_of(ShapeMeter& meter, const Signal& s, int k, int p, bool look, bool may_jump, Course course) {
    if (!reaches(k, p)) return;
    Place at = place(k, p, look);
    at.course = course;
    watch_signal<degree>(meter, s, at, may_jump, active_, quiet_);
  }
  template <int degree>
  void watch_error_of(ErrorMeter& meter, const Error& e, int k, int p) {
    if (reaches(k, p)) watch_error<degree>(meter, e, place(k, p, false), active_);
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

  const Pack& pack_;
  Span span_;
  StepMeters &w_, &d_;
  bool both_ = false;
  int panel_count_ = 0;
  Mask active_, quiet_;
  Chain<plant, filtered> chain_;
  DerivedSetpoint derived_;
  FilteredSetpoint setpoint_;
  Series error_, error1_;             ///< h and h' of a run of the setpoint's own
  Series y_, y1_, y2_, u_, u1_;       ///< y_w and u_w where they are not g0 times a series of the chain
  Lanes y_rest_, y1_rest_, u1_rest_;  ///< at least the sums of |c_k|, k >= 1, of these
  ErrorSums y_sums_;
  Lanes input_mean_;  ///< of u, without d
  Panel panels_[kernel::kMaxPanels];
  Output outputs_[kernel::kMaxPanels];
  Prefilter prefilters_[disturbed ? 1 : kernel::kMaxPanels];
};

}  // namespace portrait::PORTRAIT_ISA_NAME
