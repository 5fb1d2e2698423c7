/// Exact responses of a loop of any family, dead time after dead time, by arithmetic on power series in long double.
///
/// On one dead time the delayed output is known from the one before, so every signal of the loop solves a linear
/// equation with a known right side, and its power series follows term by term: x' = f gives x_(j+1) = f_j/(j + 1).
/// With n = 0 and an integrating plant the responses are polynomials (PID on dipdt: 3 degrees more each dead time) and
/// nothing is left out; else exponentials appear, and kTerms terms hold them to rounding when a piece is no longer than
/// some 6 of the shortest time constant.
///
/// Written from the definition of the loop in engine/loop/loop.h, block by block; nothing in common with
/// engine/reference but that header.
///
/// unit      normalised, steps of size w and d together at t = 0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/loop/loop.h"
#include "tests/oracle/power_series.h"

namespace portrait::oracle {

class MethodOfSteps {
 public:
  /// REQUIRES: pieces >= 1, into which each dead time is cut.
  MethodOfSteps(const Loop& loop, Real w, Real d, int pieces)
      : plant_(loop.family.plant),
        prefilter_(loop.family.prefilter),
        n_(loop.family.n),
        m_(loop.family.m),
        pieces_(pieces),
        w_(w),
        d_(d) {
    const Setting& s = loop.setting;
    kappa_ = s.kappa, delta_ = s.delta, tau_i_ = s.tau_i, tau_1_ = s.tau_1, tau_f_ = s.tau_f, b_ = s.b, c_ = s.c, tau_j_ = s.tau_j;
    filter_.resize(static_cast<std::size_t>(n_));
    if (plant_ == Plant::jotd) lags_.resize(static_cast<std::size_t>(loop.family.j) - 1);
    for (const double gain : s.gains) gains_.push_back(gain);
  }

  void run_to(int dead_times) {
    while (static_cast<int>(y_.size()) < dead_times * pieces_) advance();
  }

  const Signal& y() const { return y_; }
  const Signal& u() const { return u_; }

 private:
  static constexpr std::size_t kTerms = 48;  // 6^48/48! = 2e-24
  static constexpr std::array<Real, kTerms> kInverse = [] {
    std::array<Real, kTerms> inverse{};
    for (std::size_t k = 1; k < kTerms; ++k) inverse[k] = 1 / static_cast<Real>(k);
    return inverse;
  }();

  /// A state: its series on the piece at hand. Terms are made from the lowest up.
  struct State {
    PowerSeries c = PowerSeries(kTerms, 0);
    Real operator[](std::size_t j) const { return c[j]; }
    void slope(std::size_t j, Real derivative) {
      if (j + 1 < kTerms) c[j + 1] = derivative * kInverse[j + 1];
    }
    void restart(Real x) { c.assign(kTerms, 0), c[0] = x; }
  };

  void advance() {
    const std::size_t i = y_.size(), delay = static_cast<std::size_t>(pieces_);
    const Real start = static_cast<Real>(i) / pieces_, length = Real{1} / pieces_;
    const PowerSeries y = i < delay ? PowerSeries(kTerms, 0) : z_[i - delay];
    PowerSeries u(kTerms, 0);
    for (std::size_t j = 0; j < kTerms; ++j) {
      const Real y_slope = j + 1 < kTerms ? static_cast<Real>(j + 1) * y[j + 1] : 0;
      u[j] = controller(j, prefiltered(j) - y[j], y_slope);
      drive_plant(j, u[j] + (j == 0 ? d_ : 0));
    }
    y_.push_back({start, length, trimmed(y, length)});
    u_.push_back({start, length, trimmed(u, length)});
    z_.push_back(output_.c);
    for (State* state : {&lag_, &lag_slope_, &integral_, &output_, &output_slope_})
      state->restart(value(state->c, length));
    for (State& state : filter_) state.restart(value(state.c, length));
    for (State& state : lags_) state.restart(value(state.c, length));
  }

  bool integrates() const { return std::isfinite(tau_i_); }

  /// The j-th term of r.
  Real prefiltered(std::size_t j) {
    const Real w = j == 0 ? w_ : 0;
    if (prefilter_ == Prefilter::pi && integrates()) return first_order(j, w, b_ * tau_i_, tau_i_);
    if (prefilter_ != Prefilter::full) return w;
    if (integrates() && delta_ > 0) return second_order(j, w);
    if (integrates()) return first_order(j, w, b_, tau_i_);
    return delta_ > 0 ? first_order(j, w, b_, delta_ / kappa_) : w;
  }

  /// (1 + b s)/(1 + T s)
  Real first_order(std::size_t j, Real w, Real b, Real T) {
    const Real slope = (w - lag_[j]) / T;
    lag_.slope(j, slope);
    return lag_[j] + b * slope;
  }

  /// (1 + b s + c s^2)/(1 + tau_i s + tau_i tau_d s^2)
  Real second_order(std::size_t j, Real w) {
    const Real curvature = (w - lag_[j] - tau_i_ * lag_slope_[j]) / (tau_i_ * delta_ / kappa_);
    lag_.slope(j, lag_slope_[j]);
    lag_slope_.slope(j, curvature);
    return lag_[j] + b_ * lag_slope_[j] + c_ * curvature;
  }

  /// The j-th term of u.
  Real controller(std::size_t j, Real e, Real y_slope) {
    if (m_ >= 0) return gains_controller(j, e);
    Real e_slope = -y_slope;
    for (State& state : filter_) {
      e_slope = (e - state[j]) / tau_f_;
      e = state[j];
      state.slope(j, e_slope);
    }
    const Real u = kappa_ * e + delta_ * e_slope + (integrates() ? kappa_ / tau_i_ * integral_[j] : 0);
    integral_.slope(j, e);
    return u;
  }

  /// K_-1/s + K_0 + ... + K_m s^m behind n lags. With x_0 = e and x_i behind i lags, tau_f x_i' = x_(i-1) - x_i, and so for
  /// every derivative: differences, of which x_n has n without a derivative of e.
  Real gains_controller(std::size_t j, Real e) {
    const Real per_tau_f = 1 / tau_f_;
    std::vector<Real>& x = differences_;
    x.assign(1, e);
    for (const State& state : filter_) x.push_back(state[j]);
    for (std::size_t i = 0; i < filter_.size(); ++i) filter_[i].slope(j, (x[i] - x[i + 1]) * per_tau_f);
    Real u = gains_[0] * integral_[j] + gains_[1] * x.back();
    integral_.slope(j, x.back());
    for (int k = 1; k <= m_; ++k) {
      for (std::size_t i = x.size() - 1; i >= static_cast<std::size_t>(k); --i)
        x[i] = (x[i - 1] - x[i]) * per_tau_f;
      u += gains_[static_cast<std::size_t>(k) + 1] * x.back();
    }
    return u;
  }

  void drive_plant(std::size_t j, Real input) {
    switch (plant_) {
      case Plant::dipdt:
        output_.slope(j, output_slope_[j]);
        output_slope_.slope(j, input);
        break;
      case Plant::ipdt:
        output_.slope(j, input);
        break;
      case Plant::fotd:
        output_.slope(j, (input - output_[j]) / tau_1_);
        break;
      case Plant::jotd:
        for (State& lag : lags_) {
          lag.slope(j, (input - lag[j]) / tau_j_);
          input = lag[j];
        }
        output_.slope(j, (input - output_[j]) / tau_j_);
    }
  }

  Plant plant_;
  Prefilter prefilter_;
  int n_, m_, pieces_;
  Real w_, d_;
  Real kappa_, delta_, tau_i_, tau_1_, tau_f_, b_, c_, tau_j_;
  std::vector<Real> gains_, differences_;
  State lag_, lag_slope_, integral_, output_, output_slope_;
  std::vector<State> filter_, lags_;
  Signal y_, u_;
  std::vector<PowerSeries> z_;
};

}  // namespace portrait::oracle
