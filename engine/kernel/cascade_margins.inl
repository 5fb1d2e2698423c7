/// Peaks of the sensitivity functions and gain margins of a pack of open loops of many lags or of gains.
///
///     L(jw) = N(jw) e^{-jw} / ((jw)^k (1 + j tau w)^m (1 + j tau_f w)^n)        N = c_0 + c_1 s + c_2 s^2 + ...
///
/// The march is that of margins.inl. Where |L| falls and rises, polynomials of high degree, is found ahead of it, a loop at a
/// time: engine/kernel/cascade_margins.cpp.
#pragma once

#include "engine/kernel/march.inl"

namespace portrait::PORTRAIT_ISA_NAME {

class CascadeOpenLoop {
 public:
  explicit CascadeOpenLoop(const kernel::CascadeMarginPack& pack)
      : integrators(pack.integrators),
        n0(Lanes::from(pack.numerator[0])),
        degree_(pack.degree),
        lags_(pack.lags),
        filters_(pack.filters),
        lag_(Lanes::from(pack.lag)),
        tau_f_(Lanes::from(pack.tau_f)),
        rest_(Lanes::from(pack.rest)) {
    for (int i = 0; i <= degree_; ++i) numerator_[i] = Lanes::from(pack.numerator[i]);
  }

  LoopAt at(Lanes omega) const {
    Complex N = {numerator_[degree_], Lanes(0.0)}, slope = {Lanes(0.0), Lanes(0.0)};
    for (int i = degree_ - 1; i >= 0; --i) {
      slope = along(slope, omega) + N;
      N = along(N, omega) + Complex{numerator_[i], Lanes(0.0)};
    }
    const Lanes inverse = Lanes(1.0) / norm(N);
    return with_poles(omega, N, inverse, turned(inverse * (conjugate(N) * slope)));
  }

  LoopCloseAt close_at(Lanes omega) const {
    // N and its derivatives over 1, 1, 2, 6: by s.
    Complex d[4] = {};
    for (int i = degree_; i >= 0; --i) {
      for (int k = 3; k > 0; --k) d[k] = along(d[k], omega) + d[k - 1];
      d[0] = along(d[0], omega) + Complex{numerator_[i], Lanes(0.0)};
    }
    const Lanes inverse = Lanes(1.0) / norm(d[0]);
    const Complex per_N = inverse * conjugate(d[0]);
    const Complex g = turned(per_N * d[1]), bend = -(Lanes(2.0) * (per_N * d[2])), g2 = g * g;
    const Complex third = -(Lanes(6.0) * turned(per_N * d[3]));
    LoopCloseAt close{with_poles(omega, d[0], inverse, g), bend + -g2,
                      third + -(Lanes(3.0) * (bend * g)) + Lanes(2.0) * (g2 * g)};
    bend_by_poles(close, omega);
    return close;
  }

  Lanes rest() const { return rest_; }

  int integrators;
  Lanes n0;

 private:
  /// s z, s = jw
  static Complex along(Complex z, Lanes omega) { return {-(z.im * omega), z.re * omega}; }
  /// j z
  static Complex turned(Complex z) { return {-z.im, z.re}; }
  static Complex inverse_lag(Lanes t, Lanes square) {
    const Lanes inverse = Lanes(1.0) / square;
    return {inverse, -(t * inverse)};
  }
  static Lanes lag_square(Lanes t) { return mul_add(t, t, Lanes(1.0)); }

  LoopAt with_poles(Lanes omega, Complex N, Lanes inverse_square, Complex g) const {
    const SineCosine turn = sine_cosine(omega);
    const Lanes period = Lanes(1.0) / omega;
    LoopAt a{N * Complex{turn.cosine, -turn.sine}, {}, inverse_square};
    a.s = {mul_sub_from(Lanes(static_cast<double>(integrators)), period, g.re), g.im - Lanes(1.0)};
    for (int i = 0; i < integrators; ++i) {
      a.L = {a.L.im * period, -(a.L.re * period)};
      a.inverse_square = a.inverse_square * (omega * omega);
    }
    take_lags(a, lag_, omega, lags_);
    take_lags(a, tau_f_, omega, filters_);
    return a;
  }

  static void take_lags(LoopAt& a, Lanes tau, Lanes omega, int count) {
    if (count == 0) return;
    const Lanes t = tau * omega, square = lag_square(t);
    multiply_lag(a, tau, inverse_lag(t, square), square, count);
  }

  void bend_by_poles(LoopCloseAt& close, Lanes omega) const {
    const Lanes k = static_cast<double>(integrators), period = Lanes(1.0) / omega, period2 = period * period;
    close.s1.re = mul_add(k, period2, close.s1.re);
    close.s2.re = mul_sub_from(Lanes(2.0) * k, period2 * period, close.s2.re);
    bend_by(close, lag_, omega, lags_);
    bend_by(close, tau_f_, omega, filters_);
  }

  static void bend_by(LoopCloseAt& close, Lanes tau, Lanes omega, int count) {
    if (count > 0) bend_by_lag(close, tau, inverse_lag(tau * omega, lag_square(tau * omega)), count);
  }

  int degree_, lags_, filters_;
  Lanes numerator_[kernel::kMaxGains], lag_, tau_f_, rest_;
};

/// |L| over x = omega^2, known ahead.
class CascadeGain {
 public:
  explicit CascadeGain(const kernel::CascadeMarginPack& pack)
      : rises_from_(Lanes::from(pack.rises_from)),
        rises_to_(Lanes::from(pack.rises_to)),
        top_(Lanes::from(pack.top)),
        end_(Lanes::from(pack.end)) {}

  Lanes end() const { return end_; }
  Mask falls_up_to(Lanes x) const { return !(x > rises_from_); }
  Lanes square_beyond(Lanes x, Lanes here) const { return select(x < rises_to_, max(here, top_), here); }

 private:
  Lanes rises_from_, rises_to_, top_, end_;
};

struct CascadeLimits {
  Lanes leads;

  explicit CascadeLimits(const kernel::CascadeMarginPack& pack) : leads(Lanes::from(pack.leads)) {}
  /// Nothing is known of |L/(1 + L)| ahead.
  Mask damp(Lanes, Lanes, double) const { return Mask::from(0); }
};

inline void find_cascade_margins(const kernel::CascadeMarginPack& pack, kernel::MarginResult& result) {
  const CascadeOpenLoop loop(pack);
  const CascadeGain gain(pack);
  const CascadeLimits limits(pack);
  const Lanes crossover = Lanes::from(pack.crossover);
  const Mask crosses = crossover > Lanes(0.0);
  March march(loop, gain, limits);
  march.run(select(crosses, crossover, loop.rest()), all_lanes(), crosses);
  flags(!march.given_up).to(result.known);
  store_margins(march, result);
}

}  // namespace portrait::PORTRAIT_ISA_NAME
