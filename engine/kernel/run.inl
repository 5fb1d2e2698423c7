/// The closed loops of a pack, a lane each, from t = 0 to the horizon, one dead time after the other.
///
/// On one dead time the measured output y is known from the interval before, so filter, controller and plant are an open
/// chain driven by known series: every block is a tridiagonal solve or an integration in the coefficients.
///
///     e = r - y      v = Q_n e      u = kappa v + (kappa/tau_i) int v + delta v'     (n = 0: v' = -y')
///     z'' = u + d,   z' = u + d,   or   tau_1 z' + z = u + d                         y(t) = z(t - 1)
///
/// One run gives both responses: with all zero before t = 0 and d = 1, r = 0,
///
///     y_w = -(g0 int v + g1 v + g2 v')
///     u_w = y_w''(t + 1)  (dipdt),   y_w'(t + 1)  (ipdt),   tau_1 y_w'(t + 1) + y_w(t + 1)  (fotd)
///
/// with g = (kappa/tau_i) (1, b, c) behind the prefilter `full`. Other prefilters that cancel give other g.
#pragma once

#include "engine/kernel/meters.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

using kernel::Pack;
using kernel::PackResult;
using kernel::PlantKind;
using kernel::SetpointRun;

inline Series zero_series() {
  Series f;
  for (Lanes& c : f.c) c = Lanes(0.0);
  return f;
}
inline Series negated(const Series& f) {
  Series g;
  for (int k = 0; k < kTerms; ++k) g.c[k] = -f.c[k];
  return g;
}
inline Series scaled(Lanes a, const Series& f) {
  Series g;
  for (int k = 0; k < kTerms; ++k) g.c[k] = a * f.c[k];
  return g;
}
inline void add_scaled(Series& s, Lanes a, const Series& f) {
  for (int k = 0; k < kTerms; ++k) s.c[k] = mul_add(a, f.c[k], s.c[k]);
}
inline Series scaled_difference(Lanes a, const Series& f, const Series& g) {
  Series s;
  for (int k = 0; k < kTerms; ++k) s.c[k] = a * (f.c[k] - g.c[k]);
  return s;
}

/// f on [-1, end] of its panel, as a series of its own: Clenshaw's sum with series in place of numbers.
inline Series cut_off(const Series& f, Lanes end) {
  const Lanes half = Lanes(0.5) * (end + Lanes(1.0)), center = Lanes(0.5) * (end - Lanes(1.0));
  Series b1 = zero_series(), b2 = zero_series();
  const auto at_argument = [&](const Series& g) {
    Series s = scaled(center, g);
    add_scaled(s, half, times_x(g));
    return s;
  };
  for (int k = kDegree; k >= 1; --k) {
    Series b0 = scaled(Lanes((2.0 * k + 1) / (k + 1)), at_argument(b1));
    add_scaled(b0, Lanes(-(k + 1.0) / (k + 2)), b2);
    b0.c[0] += f.c[k];
    b2 = b1;
    b1 = b0;
  }
  Series sum = at_argument(b1);
  add_scaled(sum, Lanes(-0.5), b2);
  sum.c[0] += f.c[0];
  return sum;
}

/// Everything that is metered of one step.
struct StepMeters {
  ShapeMeter y, u;
  ErrorMeter e;
  void begin(Lanes y_rest, Lanes u_rest) {
    y.begin(y_rest);
    u.begin(u_rest);
    e.begin();
  }
};

inline constexpr int kMaxFilters = 16;

/// v = Q_n e with its derivatives: v[0] = v, v[1] = v', ...
struct Filtered {
  Series v[5];
};

/// One closed loop per lane: driven by d = 1, which through the identity gives both responses, or by the setpoint alone.
template <PlantKind plant, bool filtered, bool disturbed>
class Run {
 public:
  Run(const Pack& pack, StepMeters& w, StepMeters& d) : pack_(pack), w_(w), d_(d) { set_up(); }

  /// Feeds the meters of one step, or of both, up to the horizon.
  void to_horizon() {
    const int whole = static_cast<int>(pack_.horizon);
    fraction_ = pack_.horizon - whole;
    intervals_ = whole + (fraction_ > 0 ? 1 : 0);
    late_from_ = pack_.horizon > 1 ? static_cast<int>(pack_.horizon - 1) : 0;
    const int simulated = intervals_ + (both_ ? 1 : 0);
    for (int k = 0; k < simulated && any(active_); ++k) {
      const bool look = k % 8 == 7;
      quiet_ = active_;
      for (int p = 0; p < pack_.panels; ++p) panel(k, p, look);
      dead_times = select(active_, Lanes(k + 1.0), dead_times);
      if (look) rest_when_quiet();
    }
  }

  Lanes dead_times = 0.0;

 private:
  struct PanelSetup {
    Lanes start, half;  ///< of the panel in its interval; half its length
    Lag filter, plant_lag, prefilter;
  };

  /// The measured output on a panel: z of the interval before, with the derivatives in use.
  struct Delayed {
    Series y, y1, y2, y3;
  };

  /// Where a panel stands for a response: which interval of it, and which lanes count.
  struct Now {
    int interval, panel;
    Lanes middle, half;
    Mask active;
    Lanes end;    ///< x up to which the panel counts
    bool is_cut;  ///< `end` is below 1 in some lane
    bool look;    ///< whether the response is quiet is asked
  };

  void set_up() {
    kappa_ = Lanes::from(pack_.kappa);
    integral_gain_ = Lanes::from(pack_.integral_gain);
    delta_ = Lanes::from(pack_.delta);
    tau_1_ = Lanes::from(pack_.tau_1);
    tau_f_ = Lanes::from(pack_.tau_f);
    g0_ = Lanes::from(pack_.g0), g1_ = Lanes::from(pack_.g1), g2_ = Lanes::from(pack_.g2);
    both_ = disturbed && pack_.setpoint_run == SetpointRun::from_disturbance;
    has_g1_ = any(abs(g1_) > Lanes(0.0));
    has_g2_ = any(abs(g2_) > Lanes(0.0));
    active_ = Mask::from((1u << kLanes) - 1);
    Lanes start = 0.0;
    for (int p = 0; p < pack_.panels; ++p) {
      const Lanes length = Lanes::from(pack_.panel_length[p]);
      PanelSetup& setup = setups_[p];
      setup.start = start;
      setup.half = Lanes(0.5) * length;
      start += length;
      if (filtered) setup.filter.prepare(tau_f_, setup.half);
      if (plant == PlantKind::fotd) setup.plant_lag.prepare(tau_1_, setup.half);
      if (!disturbed) setup.prefilter.prepare(Lanes::from(pack_.a1), setup.half);
      Delayed& delayed = delayed_[p];
      delayed.y = delayed.y1 = delayed.y2 = delayed.y3 = zero_series();
    }
    for (Lanes& x : filter_state_) x = Lanes(0.0);
    integral_state_ = z_state_ = z1_state_ = prefilter_state_ = Lanes(0.0);
  }

  /// Lanes whose signals all stay at rest need no more intervals.
  void rest_when_quiet() {
    if (!any(quiet_)) return;
    if (disturbed) d_.y.finish(quiet_), d_.u.finish(quiet_);
    if (both_ || !disturbed) w_.y.finish(quiet_), w_.u.finish(quiet_);
    active_ = but_not(active_, quiet_);
  }

  void panel(int k, int p, bool look) {
    const PanelSetup& setup = setups_[p];
    Delayed& delayed = delayed_[p];
    Filtered f = filter(setup, delayed);
    const Series sum = integral(f.v[0], setup.half, integral_state_);

    // u and u': the ideal derivative acts on y alone.
    Series u = scaled(kappa_, f.v[0]), u1 = scaled(kappa_, filtered ? f.v[1] : error_slope(delayed));
    add_scaled(u, integral_gain_, sum);
    add_scaled(u1, integral_gain_, f.v[0]);
    add_scaled(u, delta_, f.v[1]);
    add_scaled(u1, delta_, f.v[2]);

    if (k < intervals_) {
      if (disturbed)
        watch(d_, delayed.y, delayed.y1, negated(delayed.y), u, u1, now(k, p, look));
      else
        watch_setpoint(delayed, u, u1, now(k, p, look));
    }
    if (both_) derive_setpoint(k, p, look, f, sum);

    step_plant(setup, delayed, u, u1);
    integral_state_ = mul_add(Lanes(2.0) * setup.half, f.v[0].c[0], integral_state_);
  }

  Series error_slope(const Delayed& delayed) const {
    Series e1 = negated(delayed.y1);
    if (!disturbed) add_scaled(e1, Lanes(1.0), r1_);
    return e1;
  }

  /// Q_n e; for n = 0 e itself, with -y' in place of e'.
  Filtered filter(const PanelSetup& setup, const Delayed& delayed) {
    Filtered f;
    f.v[0] = negated(delayed.y);
    f.v[1] = negated(delayed.y1);
    f.v[2] = negated(delayed.y2);
    f.v[3] = negated(delayed.y3);
    if (!disturbed) add_setpoint(setup, f);
    if (!filtered) return f;
    const Lanes rate = Lanes(1.0) / tau_f_;
    for (int i = 0; i < pack_.n; ++i) {
      Series& state_input = f.v[0];
      const Series w = setup.filter.slope(state_input, filter_state_[i]);
      Series v = state_input;
      add_scaled(v, -tau_f_, w);
      const Series w1 = scaled_difference(rate, f.v[1], w);
      if (both_ && (has_g1_ || has_g2_)) {
        const Series w2 = scaled_difference(rate, f.v[2], w1);
        if (has_g2_) f.v[4] = scaled_difference(rate, f.v[3], w2);
        f.v[3] = w2;
      }
      f.v[0] = v;
      f.v[1] = w;
      f.v[2] = w1;
      filter_state_[i] = mul_add(Lanes(2.0) * setup.half, w.c[0], filter_state_[i]);
    }
    return f;
  }

  /// r = x + b_r x' with a1 x' + x = 1; without integral action and derivative a1 = 0 and r = 1.
  void add_setpoint(const PanelSetup& setup, Filtered& f) {
    Series one = zero_series();
    one.c[0] = Lanes(1.0);
    const Series slope = setup.prefilter.slope(one, prefilter_state_);
    const Lanes a1 = Lanes::from(pack_.a1), b_r = Lanes::from(pack_.b_r);
    add_scaled(f.v[0], Lanes(1.0), one);
    add_scaled(f.v[0], b_r - a1, slope);
    // x'' = -x'/a1
    r1_ = scaled((Lanes(1.0) - b_r / a1), slope);
    if (filtered) add_scaled(f.v[1], Lanes(1.0), r1_);
    prefilter_state_ = mul_add(Lanes(2.0) * setup.half, slope.c[0], prefilter_state_);
  }

  void step_plant(const PanelSetup& setup, Delayed& delayed, const Series& u, const Series& u1) {
    Series input = u;
    if (disturbed) input.c[0] += Lanes(1.0);
    const Lanes length = Lanes(2.0) * setup.half;
    if (plant == PlantKind::dipdt) {
      const Series z1 = integral(input, setup.half, z1_state_);
      delayed.y = integral(z1, setup.half, z_state_);
      delayed.y1 = z1;
      delayed.y2 = input;
      delayed.y3 = u1;
      z_state_ = mul_add(length, z1.c[0], z_state_);
      z1_state_ = mul_add(length, input.c[0], z1_state_);
    } else if (plant == PlantKind::ipdt) {
      delayed.y = integral(input, setup.half, z_state_);
      delayed.y1 = input;
      delayed.y2 = u1;
      z_state_ = mul_add(length, input.c[0], z_state_);
    } else {
      const Series z1 = setup.plant_lag.slope(input, z_state_);
      delayed.y2 = scaled_difference(Lanes(1.0) / tau_1_, u1, z1);
      delayed.y = input;
      add_scaled(delayed.y, -tau_1_, z1);
      delayed.y1 = z1;
      z_state_ = mul_add(length, z1.c[0], z_state_);
    }
  }

  Now now(int k, int p, bool look) const {
    const PanelSetup& setup = setups_[p];
    Now at;
    at.interval = k;
    at.panel = p;
    at.half = setup.half;
    at.middle = Lanes(static_cast<double>(k)) + setup.start + setup.half;
    at.active = active_;
    at.is_cut = fraction_ > 0 && k == intervals_ - 1;
    at.look = look;
    if (at.is_cut) {
      at.end = min(Lanes(1.0), (Lanes(pack_.horizon) - at.middle) / at.half);
      at.active = at.active & (at.end > Lanes(-1.0));
    }
    return at;
  }

  /// One panel of a whole response.
  void watch(StepMeters& m, const Series& y, const Series& y1, const Series& e, const Series& u, const Series& u1,
             const Now& at) {
    watch_signal(m.y, y, y1, at, false);
    watch_signal(m.u, u, u1, at, !filtered && plant != PlantKind::dipdt);
    watch_error(m, e, at);
  }

  void watch_error(StepMeters& m, const Series& e, const Now& at) {
    if (!at.is_cut) return m.e.watch(e, at.middle, at.half, at.active);
    const Lanes half = Lanes(0.5) * at.half * (at.end + Lanes(1.0));
    m.e.watch(cut_off(e, at.end), at.middle - at.half + half, half, at.active);
  }

  void watch_signal(ShapeMeter& meter, const Series& f, const Series& slope, const Now& at, bool may_jump) {
    meter.is_late = at.interval >= late_from_;
    if (at.is_cut) return watch_cut(meter, f, slope, at);
    if (at.panel == 0 && (at.interval == 0 || may_jump)) meter.enter(value_at_start(f), at.active);
    if (at.panel == 0 && meter.is_late) meter.pass(value_at_start(f), at.active);
    meter.watch(f, slope, at.half, at.active);
    const bool last_panel = at.panel == pack_.panels - 1;
    const bool last = last_panel && at.interval == intervals_ - 1;
    if (last || (last_panel && (may_jump || at.look)) || meter.is_late) meter.pass(value_at_end(f), at.active);
    if (last) meter.finish(at.active);
    if (at.look) {
      const Lanes deviation = abs(f.c[0] - meter.rest) + rest_bound(f, 1);
      quiet_ = quiet_ & (deviation < Lanes(kQuiet) * meter.furthest);
    }
  }

  void watch_cut(ShapeMeter& meter, const Series& f, const Series& slope, const Now& at) {
    const Series g = cut_off(f, at.end), g1 = cut_off(slope, at.end);
    if (at.panel == 0) meter.enter(value_at_start(g), at.active);
    meter.watch(g, g1, at.half, at.active);
    meter.pass(value_at_end(g), at.active);
    const Mask last = but_not(at.active, at.end > Lanes(1.0 - 1e-15));
    if (any(last)) meter.finish(last);
    if (at.panel == pack_.panels - 1) meter.finish(but_not(at.active, last));
  }

  void watch_setpoint(const Delayed& delayed, const Series& u, const Series& u1, const Now& at) {
    Series e = negated(delayed.y);
    e.c[0] += Lanes(1.0);
    watch(w_, delayed.y, delayed.y1, e, u, u1, at);
  }

  /// y_w and its derivatives from v, and u_w one dead time late.
  void derive_setpoint(int k, int p, bool look, const Filtered& f, const Series& sum) {
    const auto mixed = [&](const Series& a, const Series& b, const Series& c) {
      Series s = scaled(-g0_, a);
      if (has_g1_) add_scaled(s, -g1_, b);
      if (has_g2_) add_scaled(s, -g2_, c);
      return s;
    };
    const Series y1 = mixed(f.v[0], f.v[1], f.v[2]);
    const bool for_y = k < intervals_, for_u = k >= 1;
    if (for_y || plant == PlantKind::fotd) {
      const Series y = mixed(sum, f.v[0], f.v[1]);
      if (for_y) {
        Series e = negated(y);
        e.c[0] += Lanes(1.0);
        const Now at = now(k, p, look);
        watch_signal(w_.y, y, y1, at, false);
        watch_error(w_, e, at);
      }
      if (plant == PlantKind::fotd && for_u) {
        Series u = y, u1 = y1;
        add_scaled(u, tau_1_, y1);
        add_scaled(u1, tau_1_, mixed(f.v[1], f.v[2], f.v[3]));
        watch_signal(w_.u, u, u1, now(k - 1, p, look), !filtered);
      }
    }
    if (plant == PlantKind::fotd || !for_u) return;
    const Series y2 = mixed(f.v[1], f.v[2], f.v[3]);
    if (plant == PlantKind::ipdt) return watch_signal(w_.u, y1, y2, now(k - 1, p, look), !filtered);
    watch_signal(w_.u, y2, mixed(f.v[2], f.v[3], f.v[4]), now(k - 1, p, look), false);
  }

  static constexpr double kQuiet = 1e-13;

  const Pack& pack_;
  StepMeters &w_, &d_;
  bool both_ = false, has_g1_ = false, has_g2_ = false;
  double fraction_ = 0;
  int intervals_ = 0, late_from_ = 0;
  Lanes kappa_, integral_gain_, delta_, tau_1_, tau_f_, g0_, g1_, g2_;
  Mask active_, quiet_;
  PanelSetup setups_[kernel::kMaxPanels];
  Delayed delayed_[kernel::kMaxPanels];
  Lanes filter_state_[kMaxFilters];
  Lanes integral_state_, z_state_, z1_state_, prefilter_state_;
  Series r1_;
};

inline void store_step(const StepMeters& m, kernel::StepColumns& c) {
  m.e.iae.to(c.iae), m.e.ise.to(c.ise), m.e.itae.to(c.itae), m.e.itse.to(c.itse);
  m.y.variation.to(c.tv_y), m.y.deviation(abs(m.y.rest)).to(c.tv0_y), m.y.deviation(m.y.shape1).to(c.tv1_y);
  m.y.deviation(m.y.shape2).to(c.tv2_y), m.y.largest.to(c.y_max);
  m.u.variation.to(c.tv_u), m.u.deviation(abs(m.u.rest)).to(c.tv0_u), m.u.deviation(m.u.shape1).to(c.tv1_u);
  m.u.deviation(m.u.shape2).to(c.tv2_u), m.u.largest.to(c.u_max);
}

template <PlantKind plant, bool filtered>
void run_family(const Pack& pack, PackResult& result) {
  StepMeters w, d;
  w.begin(Lanes::from(pack.y_rest_w), Lanes::from(pack.u_rest_w));
  d.begin(Lanes::from(pack.y_rest_d), Lanes::from(pack.u_rest_d));
  Run<plant, filtered, true> disturbance(pack, w, d);
  disturbance.to_horizon();
  disturbance.dead_times.to(result.dead_times);
  if (pack.setpoint_run != SetpointRun::from_disturbance) {
    Run<plant, filtered, false> setpoint(pack, w, d);
    setpoint.to_horizon();
    max(disturbance.dead_times, setpoint.dead_times).to(result.dead_times);
  }
  store_step(w, result.w);
  store_step(d, result.d);
  Lanes late = 0.0, tail = 0.0;
  const ShapeMeter* meters[] = {&w.y, &w.u, &d.y, &d.u};
  for (const ShapeMeter* m : meters) {
    late = max(late, m->late / m->furthest);
    tail = max(tail, m->tail / m->largest);
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
