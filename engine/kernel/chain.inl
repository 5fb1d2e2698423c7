/// Filter, controller and plant on a panel: from the negative error h = y - r to v = Q_n h, u and z.
///
///     v = Q_n h      u = -(kappa v + (kappa/tau_i) int v + delta v')     (n = 0: v' = y')
///     dipdt  z'' = u + d        ipdt  z' = u + d        fotd  tau_1 z' + z = u + d
///
/// One pass over the coefficients, from the highest down: the back substitution of the last lag gives its highest
/// derivative, v and the others follow, and each integration one coefficient behind what it integrates, so that nothing is
/// loaded twice. The meters' sums are taken on the way. Series that only a closer look asks for are left out and made when
/// it does (`complete`). `degree`: that of the series in use, kDegree or less.
#pragma once

#include "engine/kernel/filter.inl"
#include "engine/kernel/mesh.inl"
#include "engine/kernel/output.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// Integration of a series that comes from the highest coefficient down: give(k, f_k) returns the integral's coefficient
/// k + 1, and last(start) its first.
class Integration {
 public:
  explicit Integration(const IntegralWeights& weights) : weights_(weights) {}

  Lanes give(int k, Lanes f) {
    const Lanes weight = weights_.of[k], integral = mul_add(f, weight, -two_above_);
    two_above_ = above_;
    above_ = f * weight;
    return integral;
  }
  Lanes last(Lanes start) const { return start + (above_ - two_above_); }

 private:
  const IntegralWeights& weights_;
  Lanes above_ = 0.0, two_above_ = 0.0;  ///< weighted f_k and f_{k+1}
};

template <kernel::PlantKind kind, bool filtered>
class Chain {
 public:
  Series v, v1, v2, v3, v4, sum;                      ///< v and its derivatives; int v
  Lanes sum_rest, v_rest, v1_rest, v2_rest, u1_rest;  ///< at least the sums of |c_k|, k >= 1
  ErrorSums of_sum;

  /// `extra`: derivatives of v beyond v'' that are asked for. `sparing`: leave out what `complete` can make.
  void begin(const kernel::Pack& pack, int extra, bool sparing) {
    extra_ = extra;
    sparing_ = sparing && filtered && !kLag && extra == 0;
    tau_1_ = Lanes::from(pack.tau_1);
    level_ = kLag ? 0 : pack.slow_filter ? 1 : 1 + extra;
    if (filtered) filter_.begin(pack.n, Lanes::from(pack.tau_f), level_, 2 + extra);
    if (kLag) plant_rate_ = Lanes(1.0) / tau_1_;
    gains_ = {-Lanes::from(pack.kappa), -Lanes::from(pack.integral_gain), -Lanes::from(pack.delta)};
    integral_ = z_ = z1_ = Lanes(0.0);
    Series* const all[] = {&v, &v1, &v2, &v3, &v4, &sum};
    for (Series* const f : all) set_zero(*f);
    sum_rest = v_rest = v1_rest = v2_rest = u1_rest = Lanes(0.0);
    of_sum = {Lanes(0.0), Lanes(0.0)};
  }

  /// A panel before anything has reached the controller: u = 0, and the plant answers to d = `load` alone, which is
  /// already added where u lies among the derivatives of y.
  void run_plant_alone(const Panel& panel, Output& z) {
    Series* const all[] = {&z.y, &z.y1, &z.y2, &z.y3};
    for (Series* const f : all) set_zero(*f);
    const Lanes half = panel.half, length = 2 * panel.half;
    if constexpr (kind == kernel::PlantKind::dipdt) {
      // z' = z1 + load t, z = z0 + z1 t + load t^2/2, from the panel's start.
      z.y2[0] = load;
      z.y1[1] = half * load, z.y1[0] = z1_ + z.y1[1];
      z.y[2] = half * Lanes(1.0 / 3) * z.y1[1], z.y[1] = half * z.y1[0], z.y[0] = z_ + (z.y[1] - z.y[2]);
      z_ = mul_add(length, z.y1[0], z_);
      z1_ = mul_add(length, load, z1_);
      z.sum_up();
    } else if constexpr (kind == kernel::PlantKind::ipdt) {
      z.y1[0] = load;
      z.y[1] = half * load, z.y[0] = z_ + z.y[1];
      z_ = mul_add(length, load, z_);
      z.sum_up();
    } else {
      set_zero(z.u), set_zero(z.u1);
      step_lag<kDegree>(panel, z);
    }
  }

  /// The first panel on which h is not 0: h may jump at its start.
  void enter(const Derivatives& h) {
    if (filtered) filter_.enter(h), is_ahead_ = false;
  }

  /// From now on series end at `degree`.
  void cut_at(int degree) {
    Series* const all[] = {&v, &v1, &v2, &v3, &v4, &sum};
    for (Series* const f : all) set_zero_above(*f, degree);
  }

  /// `h1`: h'. The next dead time's y comes in place of `z`; u and u' lie among its derivatives, d = `load` not yet added.
  template <int degree>
  void run(const Panel& panel, Derivatives h, const Series& h1, Output& z) {
    if constexpr (!filtered) {
      if (extra_ > 0) copy(v3, *h.at[3]);
      pass<degree, Mode::full>(panel, h, h1, z);
    } else {
      run_filtered<degree>(panel, h, h1, z);
    }
    if constexpr (kLag) step_lag<degree>(panel, z);
  }

  /// The next panel's elimination, a chain of operations that each wait for the one before: while this panel is watched there
  /// is time for it. In vain where `forget_ahead` follows.
  template <int degree>
  void run_ahead(const Panel& panel, const Derivatives& h) {
    if (!filtered || filter_.order() != 1) return;
    filter_.template eliminate<degree>(panel.filter, h, eliminated_);
    is_ahead_ = true;
  }
  /// The next panel is another one than was thought.
  void forget_ahead() { is_ahead_ = false; }

  /// All coefficients of int v, of which the pass may have left out those in the middle.
  template <int degree>
  void complete_sum(const Panel& panel) {
    if (!sparing_) return;
    Integration of_v(panel.weights);
    for (int k = degree; k > 0; --k) {
      const Lanes integral = of_v.give(k, v[k]);
      if (k < degree) sum[k + 1] = integral;
    }
    sum[1] = of_v.give(0, v[0]);
  }

  /// All coefficients of u and u'.
  template <int degree>
  void complete_input(const Panel& panel, Output& z) {
    if (!sparing_) return;
    complete_sum<degree>(panel);
    Series &u = plant_input<kind>(z), &u1 = plant_input_slope<kind>(z);
    for (int k = 1; k <= degree; ++k) {
      u[k] = input_of(gains_, v[k], sum[k], v1[k]);
      u1[k] = input_of(gains_, v1[k], v[k], v2[k]);
    }
  }

  Lanes load = 1.0;  ///< d

 private:
  static constexpr bool kLag = kind == kernel::PlantKind::fotd;

  /// The controller's, times -1.
  struct Gains {
    Lanes kappa, integral, delta;
  };

  /// What the pass finds, and what it keeps.
  enum class Mode {
    sparing,  ///< v'' from the elimination; of int v and u the first and the last two coefficients, of u' the first
    full,     ///< all of them
    known,    ///< the same, v'' having been found
  };

  template <int degree>
  void run_filtered(const Panel& panel, Derivatives h, const Series& h1, Output& z) {
    h = filter_.template all_but_last<degree>(panel.filter, panel.half, h);
    Series& solved = kLag ? v1 : level_ == 1 ? v2 : level_ == 2 ? v3 : v4;
    if (!is_ahead_) filter_.template eliminate<degree>(panel.filter, h, eliminated_);
    is_ahead_ = false;
    if (sparing_) {
      pass<degree, kLag ? Mode::full : Mode::sparing>(panel, h, h1, z);
    } else if (kLag || extra_ == 0) {
      pass<degree, Mode::full>(panel, h, h1, z);
      if (kLag && extra_ > 0) filter_.template set_above<degree>(v3, *h.at[2], v2);
    } else {
      find_higher<degree>(panel, h, solved);
      pass<degree, kLag ? Mode::full : Mode::known>(panel, h, h1, z);
    }
    filter_.advance_last(panel.half, solved[0]);
  }

  /// v'' and above, before the pass writes where h'' and the third derivative are.
  template <int degree>
  void find_higher(const Panel& panel, const Derivatives& h, Series& solved) {
    Lanes above = 0.0;
    for (int k = degree; k >= 0; --k) solved[k] = above = panel.filter.substitute(eliminated_, k, above);
    if (level_ == 1) {
      filter_.template set_above<degree>(v3, *h.at[2], v2);
      if (extra_ > 1) filter_.template set_above<degree>(v4, *h.at[3], v3);
      return;
    }
    if (extra_ > 1) filter_.template set_below<degree>(v3, *h.at[3], v4);
    filter_.template set_below<degree>(v2, *h.at[2], v3);
  }

  /// v, v', v'' of coefficient k; what u' takes for v'.
  struct Filtered {
    Lanes v, v1, v2, slope;
  };

  /// `known`: v'' has been found; else `eliminated_` holds what elimination left of it, or of v' of a lag.
  template <bool known>
  Filtered filtered_at(int k, const Panel& panel, const Derivatives& h, const Series& h1, const Filtered& above,
                       const LagFormula& lag) {
    if constexpr (filtered && kLag) {
      const Lanes slope = panel.filter.substitute(eliminated_, k, above.v1);
      return {lag.below((*h.at[0])[k], slope), slope, lag.above((*h.at[1])[k], slope), slope};
    } else if constexpr (filtered) {
      const Lanes w = known ? v2[k] : panel.filter.substitute(eliminated_, k, above.v2);
      const Lanes slope = lag.below((*h.at[1])[k], w);
      return {lag.below((*h.at[0])[k], slope), slope, w, slope};
    }
    return {(*h.at[0])[k], (*h.at[1])[k], (*h.at[2])[k], h1[k]};
  }

  /// A coefficient of u from those of v, int v, v'; of u' from those of v', v, v''.
  static Lanes input_of(const Gains& minus, Lanes v, Lanes sum, Lanes v1) {
    return mul_add(minus.kappa, v, mul_add(minus.integral, sum, minus.delta * v1));
  }

  template <int degree, Mode mode>
  void pass(const Panel& panel, const Derivatives& h, const Series& h1, Output& z) {
    constexpr bool sparing = mode == Mode::sparing;
    // Where registers hold them they need not be loaded after every store.
    const Gains gains = gains_;
    const LagFormula lag = filter_.formula();
    Integration of_v(panel.weights), of_u(panel.weights), of_z1(panel.weights);
    Rest rest_v2, rest_u1;
    ErrorSumsTo<degree> sums, z_sums;
    Filtered above{Lanes(0.0), Lanes(0.0), Lanes(0.0), Lanes(0.0)};
    Series &u = plant_input<kind>(z), &u1 = plant_input_slope<kind>(z);
    const auto is_kept = [](int k) { return !sparing || k <= 1 || k >= degree - 1; };

    // u_k and what follows from it, one coefficient behind v.
    const auto act = [&](int k, Lanes integral) {
      const Lanes input = input_of(gains, above.v, integral, above.v1);
      if (kind == kernel::PlantKind::ipdt || is_kept(k)) u[k] = input;
      if constexpr (kind == kernel::PlantKind::dipdt) {
        const Lanes z1 = of_u.give(k, k == 0 ? input + load : input);
        if (k < degree) drive_double<degree>(k + 1, z1, of_z1, z_sums, z);
      } else if constexpr (kind == kernel::PlantKind::ipdt) {
        const Lanes y = of_u.give(k, k == 0 ? input + load : input);
        if (k < degree) z.y[k + 1] = y, z_sums.add(k + 1, y);
      }
    };

#pragma GCC unroll 16
    for (int k = degree; k >= 0; --k) {
      const Filtered here = filtered_at<mode == Mode::known>(k, panel, h, h1, above, lag);
      const Lanes integral = of_v.give(k, here.v);
      if (k < degree) {
        if (is_kept(k + 1)) sum[k + 1] = integral;
        sums.add(k + 1, integral);
        act(k + 1, integral);
      }
      if (k > 0) rest_v2.add(here.v2);
      v[k] = here.v, v1[k] = here.v1, v2[k] = here.v2;
      const Lanes slope = input_of(gains, here.slope, here.v, here.v2);
      if (k > 0) rest_u1.add(slope);
      if (!sparing || k == 0) u1[k] = slope;
      above = here;
    }
    sum[0] = of_v.last(integral_);
    integral_ = mul_add(Lanes(2 * panel.half), above.v, integral_);
    act(0, sum[0]);
    finish<degree>(panel, of_u, of_z1, z_sums, z);
    of_sum = sums.sums;
    v2_rest = rest_v2.sum;
    bound_rests(panel.half);
    u1_rest = rest_u1.sum;
    bound_output_rests(panel.half, z);
  }

  /// What is integrated from v'' and u' has no sum of its own.
  void bound_rests(double half) {
    v1_rest = filtered ? rest_of_integral(half, v2[0], v2_rest) : rest_bound(v1, 1);
    v_rest = filtered ? rest_of_integral(half, v1[0], v1_rest) : rest_bound(v, 1);
    sum_rest = rest_of_integral(half, v[0], v_rest);
  }
  void bound_output_rests(double half, Output& z) {
    if constexpr (kLag) return;
    const Lanes u_rest = rest_of_integral(half, plant_input_slope<kind>(z)[0], u1_rest);
    const Lanes driven = rest_of_integral(half, plant_input<kind>(z)[0] + load, u_rest);
    z.slope_rest = kind == kernel::PlantKind::dipdt ? driven : u_rest;
    z.rest = kind == kernel::PlantKind::dipdt ? rest_of_integral(half, z.y1[0], driven) : driven;
  }

  /// z1_k of the double integrator, and z_{k+1}.
  template <int degree>
  static void drive_double(int k, Lanes z1, Integration& of_z1, ErrorSumsTo<degree>& sums, Output& z) {
    z.y1[k] = z1;
    const Lanes y = of_z1.give(k, z1);
    if (k < degree) z.y[k + 1] = y, sums.add(k + 1, y);
  }

  /// The first coefficients, with the states at the panel's start, and the states at its end.
  template <int degree>
  void finish(const Panel& panel, Integration& of_u, Integration& of_z1, ErrorSumsTo<degree>& sums, Output& z) {
    [[maybe_unused]] const Lanes length = 2 * panel.half;
    [[maybe_unused]] const Lanes mean = plant_input<kind>(z)[0] + load;
    if constexpr (kind == kernel::PlantKind::dipdt) {
      z.y1[0] = of_u.last(z1_);
      z.y[1] = of_z1.give(0, z.y1[0]);
      sums.add(1, z.y[1]);
      z.y[0] = of_z1.last(z_);
      z_ = mul_add(length, z.y1[0], z_);
      z1_ = mul_add(length, mean, z1_);
    } else if constexpr (kind == kernel::PlantKind::ipdt) {
      z.y[0] = of_u.last(z_);
      z_ = mul_add(length, mean, z_);
    }
    if constexpr (!kLag) z.sums = sums.sums;
  }

  /// fotd: z' by the lag's solver, z = u + d - tau_1 z', z'' = (u' - z')/tau_1.
  template <int degree>
  void step_lag(const Panel& panel, Output& z) {
    z.u[0] += load;
    panel.plant.eliminate<degree>(z.y1, z.u, z_);
    Rest rest;
    ErrorSumsTo<degree> sums;
    Lanes above = 0.0;
#pragma GCC unroll 16
    for (int k = degree; k >= 0; --k) {
      z.y1[k] = above = panel.plant.substitute(z.y1, k, above);
      z.y[k] = mul_sub_from(tau_1_, above, z.u[k]);
      z.y2[k] = plant_rate_ * (z.u1[k] - above);
      if (k > 0) rest.add(above), sums.add(k, z.y[k]);
    }
    z.u[0] = z.u[0] - load;
    z_ = mul_add(Lanes(2 * panel.half), z.y1[0], z_);
    z.slope_rest = rest.sum;
    z.rest = rest_of_integral(panel.half, above, rest.sum);
    z.sums = sums.sums;
  }

  Filter filter_;
  int extra_ = 0, level_ = 1;  ///< level_: of the filter
  Lanes tau_1_, plant_rate_;
  Gains gains_;
  bool sparing_ = false;
  Series eliminated_;
  bool is_ahead_ = false;  ///< it is of the next panel
  Lanes integral_, z_, z1_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
