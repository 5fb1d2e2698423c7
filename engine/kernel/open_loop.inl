/// The open loop on the imaginary axis, a lane each.
///
///     L(jw) = N(jw) e^{-jw} / ((jw)^k (1 + j tau_1 w)^m (1 + j tau_f w)^n)        N = n0 + n1 s + n2 s^2
///
/// m is 0 or 1. All reciprocals that an evaluation needs come out of one division.
#pragma once

#include "engine/kernel/angles.inl"
#include "engine/kernel/complex.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

inline Lanes power(Lanes x, int n) {
  Lanes p = 1.0;
  for (int i = 0; i < n; ++i) p = p * x;
  return p;
}

/// L and its logarithm's slope s = L'/L.
struct LoopAt {
  Complex L, s;
  Lanes inverse_square;  ///< 1/|L|^2
};

/// s' and s'' as well.
struct LoopCloseAt {
  LoopAt at;
  Complex s1, s2;
};

/// Takes `count` equal lags into L: lag = 1/(1 + j tau w), square = 1/|lag|^2.
inline void multiply_lag(LoopAt& a, Lanes tau, Complex lag, Lanes square, int count) {
  for (int i = 0; i < count; ++i) {
    a.L = a.L * lag;
    a.inverse_square = a.inverse_square * square;
  }
  const Lanes times = Lanes(static_cast<double>(count)) * tau;
  a.s = {mul_add(times, lag.im, a.s.re), mul_sub_from(times, lag.re, a.s.im)};
}

inline void bend_by_lag(LoopCloseAt& close, Lanes tau, Complex lag, int count) {
  const Complex lag2 = lag * lag, lag3 = lag2 * lag;
  const Lanes square = Lanes(static_cast<double>(count)) * tau * tau, twice = Lanes(2.0) * tau * square;
  close.s1 = {mul_sub_from(square, lag2.re, close.s1.re), mul_sub_from(square, lag2.im, close.s1.im)};
  close.s2 = {mul_sub_from(twice, lag3.im, close.s2.re), mul_add(twice, lag3.re, close.s2.im)};
}

class OpenLoopLanes {
 public:
  explicit OpenLoopLanes(const kernel::MarginPack& pack)
      : integrators(kernel::integrators(pack.plant) + (pack.integral ? 1 : 0)),
        has_lag(pack.plant == kernel::PlantKind::fotd),
        filters(pack.n) {
    const Lanes kappa = Lanes::from(pack.kappa), delta = Lanes::from(pack.delta);
    n0 = pack.integral ? kappa / Lanes::from(pack.tau_i) : kappa;
    n1 = pack.integral ? kappa : delta;
    n2 = pack.integral ? delta : Lanes(0.0);
    tau_1 = has_lag ? Lanes::from(pack.tau_1) : Lanes(0.0);
    tau_f = filters > 0 ? Lanes::from(pack.tau_f) : Lanes(0.0);
    middle = mul_sub_from(Lanes(2.0) * n0, n2, n1 * n1);
    lags = mul_add(Lanes(static_cast<double>(filters)), tau_f, Lanes(1.0) + tau_1);
  }

  LoopAt at(Lanes omega) const { return at(parts_at(omega)); }

  LoopCloseAt close_at(Lanes omega) const {
    const Parts p = parts_at(omega);
    const Complex bend = (Lanes(-2.0) * n2 * p.inverse_N) * conjugate(p.N), g1 = bend + -(p.g * p.g);
    LoopCloseAt close{at(p), g1, -(p.g * (bend + Lanes(2.0) * g1))};
    const Lanes k = static_cast<double>(integrators), period2 = p.period * p.period;
    close.s1.re = mul_add(k, period2, close.s1.re);
    close.s2.re = mul_sub_from(Lanes(2.0) * k, period2 * p.period, close.s2.re);
    if (has_lag) bend_by_lag(close, tau_1, p.lag, 1);
    if (filters > 0) bend_by_lag(close, tau_f, p.filter, filters);
    return close;
  }

  /// |N|^2 = n0^2 + (n1^2 - 2 n0 n2) w^2 + n2^2 w^4, x = w^2
  Lanes numerator_square(Lanes x) const { return mul_add(x, mul_add(n2 * n2, x, middle), n0 * n0); }
  Lanes lag_square(Lanes x) const { return mul_add(tau_1 * tau_1, x, Lanes(1.0)); }
  Lanes filter_square(Lanes x) const { return mul_add(tau_f * tau_f, x, Lanes(1.0)); }

  /// arg L, continuous from -k pi/2 at omega = 0. The angles of N, in [0, pi], and of two lags are one of [-pi, pi].
  Lanes phase(Lanes omega) const {
    Complex turned = {mul_sub_from(n2 * omega, omega, n0), n1 * omega};
    if (has_lag) turned = turned * Complex{Lanes(1.0), -(tau_1 * omega)};
    Lanes phase = -omega - Lanes(integrators * (kPi / 2));
    if (filters == 1) turned = turned * Complex{Lanes(1.0), -(tau_f * omega)};
    if (filters > 1) phase = mul_sub_from(Lanes(static_cast<double>(filters)), arc_tangent(tau_f * omega), phase);
    return phase + angle(turned.re, turned.im);
  }

  /// Below this omega L is what it is at rest, without integrator.
  Lanes rest() const { return Lanes(1e-3) / (lags + n1 / n0); }

  int integrators;
  bool has_lag;
  int filters;
  Lanes n0, n1, n2, tau_1, tau_f;  ///< a time constant that the loop lacks is 0
  Lanes middle;                    ///< n1^2 - 2 n0 n2
  Lanes lags;                      ///< delay included: arg L falls by no more than this times omega

 private:
  struct Parts {
    Lanes omega;
    Complex N, g, lag, filter;  ///< g = N'/N, lag = 1/(1 + j tau_1 w), filter = 1/(1 + j tau_f w)
    Lanes inverse_N, period, lag_square, filter_square;  ///< 1/|N|^2, 1/w, and the squares, not inverted
  };

  Parts parts_at(Lanes omega) const {
    Parts p;
    p.omega = omega;
    const Lanes x = omega * omega, bent = n2 * omega;
    p.N = {mul_sub_from(bent, omega, n0), n1 * omega};
    p.lag_square = lag_square(x), p.filter_square = filter_square(x);
    const Lanes N = norm(p.N), N_omega = N * omega, both = p.lag_square * p.filter_square;
    const Lanes inverse = Lanes(1.0) / (N_omega * both);
    const Lanes without_lags = inverse * both, of_lags = inverse * N_omega;
    p.inverse_N = without_lags * omega, p.period = without_lags * N;
    p.lag = lag_of(tau_1 * omega, of_lags * p.filter_square);
    p.filter = lag_of(tau_f * omega, of_lags * p.lag_square);
    const Complex slope = {Lanes(-2.0) * bent, n1};
    p.g = p.inverse_N * (slope * conjugate(p.N));
    return p;
  }

  static Complex lag_of(Lanes t, Lanes inverse_square) { return {inverse_square, -(t * inverse_square)}; }

  LoopAt at(const Parts& p) const {
    const SineCosine turn = sine_cosine(p.omega);
    LoopAt a;
    a.L = p.N * Complex{turn.cosine, -turn.sine};
    a.s = {mul_sub_from(Lanes(static_cast<double>(integrators)), p.period, p.g.re), p.g.im - Lanes(1.0)};
    a.inverse_square = p.inverse_N;
    for (int i = 0; i < integrators; ++i) {
      a.L = {a.L.im * p.period, -(a.L.re * p.period)};
      a.inverse_square = a.inverse_square * (p.omega * p.omega);
    }
    if (has_lag) multiply_lag(a, tau_1, p.lag, p.lag_square, 1);
    if (filters > 0) multiply_lag(a, tau_f, p.filter, p.filter_square, filters);
    return a;
  }
};

}  // namespace portrait::PORTRAIT_ISA_NAME
