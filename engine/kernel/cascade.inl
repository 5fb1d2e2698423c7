/// Controllers given by their gains and plants of many lags, on a panel: what chain.inl is for the basic families.
///
///     u = -(K_-1 int + K_0 + K_1 s + ... + K_m s^m) F^n h        F = 1/(tau_f s + 1), n >= m, h = y - r
///     z = 1/(s^k (tau_j s + 1)^j) (u + d)
///
/// n - m lags in a row, then m more, each of which is solved for the highest derivative that it gives in its own right:
///
///     x_k = s^k F^i h:  lag i + 1 solved for its slope from x_i gives x_{i+1};  below it F x_k = x_k - tau_f x_{k+1}
///
/// so nothing is divided by tau_f, and all states are continuous whatever h does. With n = 0 the derivative is y', of the
/// plant's last lag. Slower a panel than chain.inl, and no response is derived from another: each step has its run.
/// accuracy  tests/engine/kernel/cascade_test.cpp
#pragma once

#include "engine/kernel/chain.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// What Run reads of a chain whose setpoint response follows from the disturbance's. A cascade's never does.
struct DerivedSources {
  Series v, v1, v2, v3, v4, sum;
  Lanes sum_rest, v_rest, v1_rest, v2_rest;
  ErrorSums of_sum;
};

/// u = -(...) h on a panel, as above.
template <bool filtered>
class GainsController {
 public:
  void begin(const kernel::Pack& pack) {
    m_ = pack.m, plain_lags_ = pack.n - pack.m;
    tau_ = filtered ? Lanes::from(pack.tau_f) : Lanes(0.0);
    for (int i = 0; i < kernel::kMaxGains; ++i) minus_[i] = -Lanes::from(pack.gains[i]);
    for (Lanes& x : state_) x = Lanes(0.0);
    integral_ = Lanes(0.0);
  }

  template <int degree>
  void run(const Panel& panel, const Derivatives& h, Series& u) {
    const Series& last = filtered ? through_lags<degree>(panel, *h.at[0]) : *h.at[0];
    const Lanes start = integral_;
    integral_ = mul_add(Lanes(2 * panel.half), last[0], integral_);
    Integration of_last(panel.weights);
    Lanes above = 0.0;
    for (int k = degree; k >= 0; --k) {
      const Lanes integral = of_last.give(k, last[k]);
      if (k < degree) u[k + 1] = mul_add(minus_[0], integral, above);
      above = input_without_integral(k, last, h);
    }
    u[0] = mul_add(minus_[0], of_last.last(start), above);
  }

 private:
  Lanes input_without_integral(int k, const Series& last, const Derivatives& h) const {
    Lanes sum = minus_[1] * last[k];
    if constexpr (!filtered) return mul_add(minus_[2], (*h.at[1])[k], sum);
    for (int i = 1; i <= m_; ++i) sum = mul_add(minus_[i + 1], x_[i][k], sum);
    return sum;
  }

  /// x_[0] .. x_[m], the derivatives of F^n h.
  template <int degree>
  const Series& through_lags(const Panel& panel, const Series& h) {
    int lag = 0;
    const Series* input = &h;
    for (; lag < plain_lags_; ++lag, input = &x_[0]) one_lag<degree>(panel, *input, lag, 0);
    for (int highest = 1; highest <= m_; ++highest, ++lag, input = &x_[0])
      one_lag<degree>(panel, highest == 1 ? *input : x_[highest - 1], lag, highest - 1, input);
    return x_[0];
  }

  /// One lag more. `input`: the derivative of order `level` of what goes in; `lowest`: what goes in.
  template <int degree>
  void one_lag(const Panel& panel, const Series& input, int lag, int level, const Series* lowest = nullptr) {
    Series& slope = x_[level + 1];
    panel.filter.set_slope<degree>(slope, input, state_[lag]);
    state_[lag] = mul_add(Lanes(2 * panel.half), slope[0], state_[lag]);
    for (int i = level; i >= 0; --i) {
      const Series& from = i > 0 || lowest == nullptr ? (i == level ? input : x_[i]) : *lowest;
      for (int k = 0; k <= degree; ++k) x_[i][k] = mul_sub_from(tau_, x_[i + 1][k], from[k]);
    }
  }

  int m_ = 0, plain_lags_ = 0;
  Lanes tau_, integral_;
  Lanes minus_[kernel::kMaxGains];
  Lanes state_[kernel::kMaxFilters];  ///< of every lag the value at the panel's start of what its slope is taken of
  Series x_[kernel::kMaxGains];
};

/// z from u + d on a panel: lags, then integrators.
class CascadePlant {
 public:
  void begin(const kernel::Pack& pack) {
    lags_ = pack.lags, integrators_ = pack.integrators;
    tau_ = Lanes::from(pack.tau_1), rate_ = Lanes(1.0) / tau_;
    for (Lanes& x : state_) x = Lanes(0.0);
  }

  /// z and z'; z'' as well where `curved`. `input` is u + d, `slope` its slope.
  template <int degree>
  void run(const Panel& panel, const Series& input, const Series& slope, bool curved, Output& z) {
    const Series *into = &input, *slope_into = &slope;
    for (int i = 0; i < lags_; ++i) {
      Series& out = rows_[i % 2];
      Series& slope_out = slopes_[i % 2];
      panel.plant.set_slope<degree>(slope_out, *into, state_[i]);
      advance(i, panel, slope_out[0]);
      if (curved && i + 1 == lags_ + integrators_)
        for (int k = 0; k <= degree; ++k) z.y2[k] = rate_ * ((*slope_into)[k] - slope_out[k]);
      for (int k = 0; k <= degree; ++k) out[k] = mul_sub_from(tau_, slope_out[k], (*into)[k]);
      into = &out, slope_into = &slope_out;
    }
    for (int i = lags_; i < lags_ + integrators_; ++i) {
      Series& out = rows_[i % 2];
      integrate<degree>(panel, *into, i, out);
      if (curved && i + 1 == lags_ + integrators_) copy_to<degree>(z.y2, *slope_into);
      slope_into = into, into = &out;
    }
    copy_to<degree>(z.y1, *slope_into);
    copy_to<degree>(z.y, *into);
  }

 private:
  void advance(int i, const Panel& panel, Lanes mean_slope) {
    state_[i] = mul_add(Lanes(2 * panel.half), mean_slope, state_[i]);
  }

  template <int degree>
  void integrate(const Panel& panel, const Series& f, int i, Series& to) {
    Integration of_f(panel.weights);
    for (int k = degree; k > 0; --k) {
      const Lanes c = of_f.give(k, f[k]);
      if (k < degree) to[k + 1] = c;
    }
    to[1] = of_f.give(0, f[0]);
    to[0] = of_f.last(state_[i]);
    advance(i, panel, f[0]);
  }

  template <int degree>
  static void copy_to(Series& to, const Series& f) {
    for (int k = 0; k <= degree; ++k) to[k] = f[k];
  }

  int lags_ = 0, integrators_ = 0;
  Lanes tau_, rate_;
  Lanes state_[kernel::kMaxPlantOrder + 2];
  Series rows_[2], slopes_[2];
};

template <bool filtered>
class Chain<kernel::PlantKind::cascade, filtered> : public DerivedSources {
 public:
  Lanes u1_rest;  ///< at least the sum of |c_k|, k >= 1, of u'
  Lanes load = 1.0;

  void begin(const kernel::Pack& pack, int, bool) {
    controller_.begin(pack);
    plant_.begin(pack);
  }
  void enter(const Derivatives&) {}
  void cut_at(int) {}

  /// A panel before anything has reached the controller.
  void run_plant_alone(const Panel& panel, Output& z) {
    z.begin();
    set_zero(z.u), set_zero(z.u1);
    run_plant<kDegree>(panel, z);
  }

  template <int degree>
  void run(const Panel& panel, const Derivatives& h, const Series&, Output& z) {
    controller_.template run<degree>(panel, h, z.u);
    set_slope_of_input<degree>(panel, z);
    run_plant<degree>(panel, z);
    u1_rest = rest_bound<degree>(z.u1, 1);
  }

  template <int degree>
  void run_ahead(const Panel&, const Derivatives&) {}
  void forget_ahead() {}
  template <int degree>
  void complete_sum(const Panel&) {}
  template <int degree>
  void complete_input(const Panel&, Output&) {}

 private:
  template <int degree>
  void run_plant(const Panel& panel, Output& z) {
    z.u[0] += load;
    plant_.template run<degree>(panel, z.u, z.u1, !filtered, z);
    z.u[0] = z.u[0] - load;
    z.rest = rest_bound<degree>(z.y, 1), z.slope_rest = rest_bound<degree>(z.y1, 1);
    z.sums = error_sums_of(z.y);
  }

  /// u' of the series of u: it says where u turns, and no response is made of it but the y'' of an ideal derivative.
  template <int degree>
  static void set_slope_of_input(const Panel& panel, Output& z) {
    set_derivative<degree>(z.u1, z.u);
    const Lanes rate = 1 / panel.half;
    for (int k = 0; k <= degree; ++k) z.u1[k] = rate * z.u1[k];
  }

  GainsController<filtered> controller_;
  CascadePlant plant_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
