/// The open loop on the imaginary axis, a lane each.
///
///     L(jw) = N(jw) e^{-jw} / ((jw)^k (1 + j tau_1 w)^m (1 + j tau_f w)^n)        N = n0 + n1 s + n2 s^2, see open_loop.h
#pragma once

#include "engine/kernel/angles.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

struct Complex {
  Lanes re, im;
};
inline Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
inline Complex operator-(Complex a) { return {-a.re, -a.im}; }
inline Complex operator*(Complex a, Complex b) {
  return {mul_sub_from(a.im, b.im, a.re * b.re), mul_add(a.re, b.im, a.im * b.re)};
}
inline Complex operator*(Lanes a, Complex b) { return {a * b.re, a * b.im}; }
inline Lanes norm(Complex a) { return mul_add(a.re, a.re, a.im * a.im); }
/// Re(conj(a) b)
inline Lanes inner(Complex a, Complex b) { return mul_add(a.re, b.re, a.im * b.im); }
inline Complex inverse(Complex a) {
  const Lanes scale = Lanes(1.0) / norm(a);
  return {a.re * scale, -(a.im * scale)};
}

inline constexpr double kPi = 3.14159265358979323846;

class OpenLoopLanes {
 public:
  explicit OpenLoopLanes(const kernel::MarginPack& pack)
      : n0_(Lanes::from(pack.n0)),
        n1_(Lanes::from(pack.n1)),
        n2_(Lanes::from(pack.n2)),
        tau_1_(Lanes::from(pack.tau_1)),
        tau_f_(Lanes::from(pack.tau_f)),
        integrators_(pack.integrators),
        plant_lags_(pack.plant_lags),
        filters_(pack.n) {}

  /// L, its logarithm's derivative s = L'/L, and s'.
  struct At {
    Complex L, s, ds;
  };

  At at(Lanes omega) const {
    const Complex N = numerator(omega), slope = {Lanes(-2.0) * n2_ * omega, n1_};
    const Complex inverse_N = inverse(N), g = slope * inverse_N;
    const Complex bend = (Lanes(-2.0) * n2_) * inverse_N, g2 = g * g;
    At a;
    a.ds = {bend.re - g2.re, bend.im - g2.im};
    a.s = {g.re, g.im - Lanes(1.0)};
    const SineCosine turn = sine_cosine(omega);
    a.L = N * Complex{turn.cosine, -turn.sine};
    const Lanes period = Lanes(1.0) / omega;
    for (int i = 0; i < integrators_; ++i) {
      a.L = {a.L.im * period, -(a.L.re * period)};
      a.s.re = a.s.re - period;
      a.ds.re = mul_add(period, period, a.ds.re);
    }
    if (plant_lags_ > 0) multiply_lag(a, tau_1_, omega, plant_lags_);
    if (filters_ > 0) multiply_lag(a, tau_f_, omega, filters_);
    return a;
  }

  /// |L|^2
  Lanes square(Lanes omega) const {
    const Lanes x = omega * omega;
    Lanes square = norm(numerator(omega));
    Lanes below = 1.0;
    for (int i = 0; i < integrators_; ++i) below = below * x;
    if (plant_lags_ > 0) below = below * lag_square(tau_1_, x);
    const Lanes filter = lag_square(tau_f_, x);
    for (int i = 0; i < filters_; ++i) below = below * filter;
    return square / below;
  }

  /// d ln|L| / d ln omega
  Lanes log_log_slope(Lanes omega) const {
    const Lanes x = omega * omega;
    const Complex N = numerator(omega);
    const Lanes rise = mul_add(n1_, n1_, Lanes(-2.0) * n2_ * N.re) * x / norm(N);
    Lanes slope = rise - Lanes(static_cast<double>(integrators_));
    if (plant_lags_ > 0) slope = slope - lag_slope(tau_1_, x);
    if (filters_ > 0) slope = slope - Lanes(static_cast<double>(filters_)) * lag_slope(tau_f_, x);
    return slope;
  }

  /// arg L, continuous from -k pi/2 at omega = 0: the imaginary part of N stays above 0.
  Lanes phase(Lanes omega) const {
    const Complex N = numerator(omega);
    Lanes phase = upper_angle(N.re, N.im) - omega - Lanes(integrators_ * (kPi / 2));
    if (plant_lags_ > 0) phase = phase - arc_tangent(tau_1_ * omega);
    if (filters_ > 0)
      phase = mul_sub_from(Lanes(static_cast<double>(filters_)), arc_tangent(tau_f_ * omega), phase);
    return phase;
  }

  /// At least |L|^2 everywhere beyond omega: every term of |N|^2 over |D|^2, bounded by something that falls. A power of
  /// omega too many is taken up by the plant's lag.
  Lanes square_beyond(Lanes omega) const {
    const Lanes x = omega * omega, per_x = Lanes(1.0) / x;
    Lanes common = 1.0, without_lag = 1.0;
    const Lanes filter = lag_square(tau_f_, x);
    for (int i = 0; i < filters_; ++i) common = common / filter;
    without_lag = common;
    if (plant_lags_ > 0) common = common / lag_square(tau_1_, x);
    const auto term = [&](Lanes c, int power) {
      const int excess = power - integrators_;
      if (excess > 0) return c * without_lag / (tau_1_ * tau_1_);
      Lanes t = c * common;
      for (int i = excess; i < 0; ++i) t = t * per_x;
      return t;
    };
    return term(n0_ * n0_, 0) + term(max(Lanes(0.0), middle_term()), 1) + term(n2_ * n2_, 2);
  }

  /// Lanes in which |L| falls everywhere: so do its parts 1/(1 + tau^2 w^2), and |N|^2/w^2k does by its own slope.
  Mask falls() const {
    if (integrators_ == 1) return n2_ < Lanes(1e-300);
    if (integrators_ == 2) return middle_term() > Lanes(0.0);
    return middle_term() > Lanes(-1.7320508075688772) * n0_ * n2_;
  }

  /// Lanes in which |L| falls all the way up to omega.
  Mask falls_up_to(Lanes omega) const {
    const Lanes x = omega * omega;
    if (integrators_ == 1) return n2_ * x < n0_;
    return falls() | (middle_term() * x > Lanes(-2.0) * n0_ * n0_);
  }

  /// Lanes in which arg L stays above -pi all the way up to omega.
  Mask leads_up_to(Lanes omega) const {
    if (integrators_ == 1) return sum_of_lags() * omega < Lanes(kPi / 2);
    if (integrators_ == 2) return arc_tangent(n1_ / n0_ * omega) > sum_of_lags() * omega;
    return Mask::from(0);
  }

  /// Lanes in which |L/(1 + L)| stays below 1 all the way up to omega. With M = 1/L, |1 + M|^2 = 1 + |M| (|M| + 2 cos arg M),
  /// and for one integrator, a = n1/n0 and n2 w^2 < 2 n0,
  ///
  ///     |M| >= w/(n0 sqrt(1 + a^2 w^2)),     cos arg M >= -w (lags - a/(1 + a^2 w^2))
  ///
  /// which once compared stays so for every smaller w. More integrators always overshoot.
  Mask damped_up_to(Lanes omega) const {
    if (integrators_ != 1) return Mask::from(0);
    const Lanes a = n1_ / n0_, square = mul_add(a * omega, a * omega, Lanes(1.0));
    const Lanes least = Lanes(1.0) / (n0_ * sqrt(square)), most = Lanes(2.0) * (sum_of_lags() - a / square);
    return (least > most) & (n2_ * omega * omega < n0_);
  }

 private:
  /// Delay included: arg L falls by no more than this times omega.
  Lanes sum_of_lags() const {
    const Lanes plant = plant_lags_ > 0 ? tau_1_ : Lanes(0.0), filter = filters_ > 0 ? tau_f_ : Lanes(0.0);
    return Lanes(1.0) + plant + Lanes(static_cast<double>(filters_)) * filter;
  }

  /// |N|^2 = n0^2 + (n1^2 - 2 n0 n2) w^2 + n2^2 w^4
  Lanes middle_term() const { return mul_sub_from(Lanes(2.0) * n0_, n2_, n1_ * n1_); }

  Complex numerator(Lanes omega) const { return {mul_sub_from(n2_ * omega, omega, n0_), n1_ * omega}; }
  static Lanes lag_square(Lanes tau, Lanes x) { return mul_add(tau * tau, x, Lanes(1.0)); }
  static Lanes lag_slope(Lanes tau, Lanes x) {
    const Lanes square = tau * tau * x;
    return square / (Lanes(1.0) + square);
  }

  /// times 1/(1 + j tau omega)^count
  static void multiply_lag(At& a, Lanes tau, Lanes omega, int count) {
    const Lanes t = tau * omega, re = Lanes(1.0) / mul_add(t, t, Lanes(1.0));
    const Complex q = {re, -(t * re)}, q2 = q * q;
    const Lanes times = static_cast<double>(count);
    for (int i = 0; i < count; ++i) a.L = a.L * q;
    a.s = {mul_add(times * tau, q.im, a.s.re), mul_sub_from(times * tau, q.re, a.s.im)};
    const Lanes square = times * tau * tau;
    a.ds = {mul_sub_from(square, q2.re, a.ds.re), mul_sub_from(square, q2.im, a.ds.im)};
  }

  Lanes n0_, n1_, n2_, tau_1_, tau_f_;
  int integrators_, plant_lags_, filters_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
