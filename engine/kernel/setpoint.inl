/// The response to the setpoint: from the disturbance run by the identity, or driven through the prefilter.
#pragma once

#include "engine/kernel/pack.h"
#include "engine/kernel/prefilter.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// y_w and u_w by the identity. Level 0 is y_w, level 1 y_w', ...: each a sum of three neighbours among int v, v, v', ...
class DerivedSetpoint {
 public:
  void begin(const kernel::Pack& pack) {
    g0_ = Lanes::from(pack.g0), g1_ = Lanes::from(pack.g1), g2_ = Lanes::from(pack.g2);
    has_g1_ = any(abs(g1_) > Lanes(0.0));
    has_g2_ = any(abs(g2_) > Lanes(0.0));
  }

  /// Every level is g0 times one series.
  bool is_scaled() const { return !has_g1_ && !has_g2_; }
  Lanes scale() const { return g0_; }

  /// Derivatives of v beyond v'' that u_w' asks for.
  int extra(kernel::PlantKind plant) const {
    const int terms = has_g2_ ? 2 : has_g1_ ? 1 : 0;
    return plant == kernel::PlantKind::dipdt ? terms : terms == 2 ? 1 : 0;
  }

  template <typename Chain>
  void set(Series& to, int level, const Chain& chain) const {
    const Series* const terms[] = {&chain.sum, &chain.v, &chain.v1, &chain.v2, &chain.v3, &chain.v4};
    set_scaled(to, g0_, *terms[level]);
    if (has_g1_) add_scaled(to, g1_, *terms[level + 1]);
    if (has_g2_) add_scaled(to, g2_, *terms[level + 2]);
  }

 private:
  Lanes g0_, g1_, g2_;
  bool has_g1_ = false, has_g2_ = false;
};

/// What y_w and u_w are multiplied by after all else: g0 where they are g0 times one series, else 1.
inline Lanes scale_of_setpoint(const kernel::Pack& pack) {
  DerivedSetpoint derived;
  derived.begin(pack);
  const bool scaled = pack.setpoint_run == kernel::SetpointRun::from_disturbance && derived.is_scaled();
  return scaled ? derived.scale() : Lanes(1.0);
}

/// r = F w on the panels one after the other, w = 1 from t = 0.
class FilteredSetpoint {
 public:
  Series r, r1;

  void begin(const kernel::Pack& pack) {
    second_order_ = pack.setpoint_run == kernel::SetpointRun::second_order;
    a1_ = Lanes::from(pack.a1), a2_ = Lanes::from(pack.a2);
    b_ = Lanes::from(pack.b_r), c_ = Lanes::from(pack.c_r);
    x_ = x1_ = Lanes(0.0);
  }

  void prepare(Prefilter& prefilter, double half_length) const {
    if (second_order_)
      prefilter.oscillator.prepare(a1_, a2_, half_length);
    else
      prefilter.lag.prepare(a1_, half_length);
  }

  void next(const Prefilter& prefilter, double half_length) {
    if (second_order_)
      next_of_oscillator(prefilter.oscillator, half_length);
    else
      next_of_lag(prefilter.lag, half_length);
  }

 private:
  /// r = x + b x' with a1 x' + x = 1, x'' = -x'/a1.
  void next_of_lag(const Lag& lag, double half_length) {
    set_zero(r);
    r[0] = Lanes(1.0);
    lag.set_slope(r1, r, x_);
    x_ = mul_add(Lanes(2 * half_length), r1[0], x_);
    const Lanes lead = b_ - a1_, lead1 = Lanes(1.0) - b_ / a1_;
    for (int k = 0; k < kTerms; ++k) {
      r[k] = mul_add(lead, r1[k], r[k]);
      r1[k] = lead1 * r1[k];
    }
  }

  /// r = x + b x' + c x'' with a2 x'' + a1 x' + x = 1; the third derivative of x is -(x' + a1 x'')/a2.
  void next_of_oscillator(const Oscillator& o, double half_length) {
    const Lanes missing = Lanes(1.0) - x_, start = x1_, rate = c_ / a2_, length = 2 * half_length;
    for (int k = 0; k < kTerms; ++k) {
      const Lanes x2 = mul_add(missing, o.x2_of_missing[k], start * o.x2_of_slope[k]);
      const Lanes x1 = mul_add(missing, o.x1_of_missing[k], start * o.x1_of_slope[k]);
      r[k] = mul_add(b_ - a1_, x1, (c_ - a2_) * x2);
      r1[k] = mul_add(Lanes(1.0) - rate, x1, mul_sub_from(rate, a1_, b_) * x2);
      if (k > 0) continue;
      x_ = mul_add(length, x1, x_);
      x1_ = mul_add(length, x2, x1_);
    }
    r[0] += Lanes(1.0);
  }

  bool second_order_ = false;
  Lanes a1_, a2_, b_, c_;
  Lanes x_, x1_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
