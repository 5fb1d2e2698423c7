/// A prefilter that cancels the controller's zeros makes the setpoint response a filtered disturbance response:
///
///     full, tau_i < inf    Y_w = (kappa/tau_i) (1/s) (1 + b s + c s^2) Q Y_d
///     full, tau_i = inf    Y_w = kappa (1 + b s) Q Y_d
///     pi, n = 0            Y_w = (kappa/tau_i) (1/s) (1 + b tau_i s) Y_d
///
/// and U_w is the same of U_d + D. The simulation solves both responses on their own, the setpoint's through the
/// prefilter, so the identity checks it sharply and from outside.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/response.h"
#include "tests/oracle/quadrature.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

using oracle::Random;

/// A signal through n lags 1/(T s + 1) and its integral, stepped over stretches on which it is smooth.
class LagChain {
 public:
  LagChain(int n, double T) : T_(T), lag_(static_cast<std::size_t>(n), 0) {}

  /// Over [from, to], no longer than T, with the exact transition and a Gauss rule for the input's part.
  template <typename Function>
  void advance(double from, double to, const Function& f) {
    const double input = oracle::integral(kRule, from, to, f);
    std::vector<double> next(lag_.size(), 0);
    for (std::size_t k = 0; k < lag_.size(); ++k) {
      for (std::size_t j = 0; j <= k; ++j) next[k] += weight(k - j, to - from) * lag_[j];
      next[k] += oracle::integral(kRule, from, to, [&](double t) { return weight(k, to - t) * f(t); }) / T_;
    }
    integral_ += input;
    for (std::size_t k = 0; k < lag_.size(); ++k) integral_ -= T_ * (next[k] - lag_[k]);
    lag_ = next;
    input_ = f(to);
  }

  double output() const { return lag_.empty() ? input_ : lag_.back(); }
  double integral() const { return integral_; }
  double slope() const { return ((lag_.size() == 1 ? input_ : lag_[lag_.size() - 2]) - lag_.back()) / T_; }

 private:
  /// (x/T)^j e^{-x/T}/j!
  double weight(std::size_t j, double x) const {
    return std::pow(x / T_, static_cast<double>(j)) * std::exp(-x / T_) / std::tgamma(static_cast<double>(j + 1));
  }

  inline static const oracle::GaussRule kRule = oracle::gauss_rule(16);
  double T_;
  std::vector<double> lag_;
  double input_ = 0, integral_ = 0;
};

/// What the identity makes of a disturbance response at the end of the chain.
double setpoint_response(const Loop& loop, const LagChain& chain) {
  const Setting& s = loop.setting;
  const bool full = loop.family.prefilter == Prefilter::full;
  if (!has_integral_action(s)) return s.kappa * (chain.output() + (s.b != 0 ? s.b * chain.slope() : 0));
  const double b = full ? s.b : s.b * s.tau_i;
  const double c_part = s.c != 0 ? s.c * chain.slope() : 0;
  return s.kappa / s.tau_i * (chain.integral() + b * chain.output() + c_part);
}

/// Largest difference at the ends of all pieces, relative to the setpoint response's largest value.
double identity_error(const Loop& loop, const Response& r, Series Piece::*signal, double offset) {
  const auto &from = r.steps[kDisturbance].pieces, &to = r.steps[kSetpoint].pieces;
  LagChain chain(loop.family.n, loop.setting.tau_f);
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Piece& piece = from[i];
    const auto f = [&](double x) { return value(piece.*signal, x) + offset; };
    const double T = loop.family.n > 0 ? loop.setting.tau_f : piece.length;
    const int parts = 1 + static_cast<int>(piece.length / T);
    for (int part = 0; part < parts; ++part) {
      const double left = piece.length * part / parts, right = piece.length * (part + 1) / parts;
      chain.advance(left, right, [&](double x) { return f(2 * x / piece.length - 1); });
    }
    const double expected = value(to[i].*signal, 1);
    worst = std::max(worst, std::abs(setpoint_response(loop, chain) - expected));
    largest = std::max(largest, bound(to[i].*signal));
  }
  return worst / largest;
}

void expect_identity(const Loop& loop) {
  SCOPED_TRACE(simulate_command(loop));
  const Response r = simulate(loop, Horizon::fixed(30));
  EXPECT_LT(identity_error(loop, r, &Piece::y, 0), 1e-10);
  EXPECT_LT(identity_error(loop, r, &Piece::u, 1), 1e-10);
}

TEST(Identity, OfThePublishedLoop) {
  expect_identity(
      {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1}});
  expect_identity({{Plant::dipdt, 1, Prefilter::full},
                   {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1, .b = 4.8, .c = 5.7}});
}

TEST(Identity, OfTheFullPrefilterWithWeightsOnAllPlants) {
  Random random(21);
  for (int trial = 0; trial < 36; ++trial) {
    const auto plant = static_cast<Plant>(trial % 3);
    Loop loop = oracle::random_stable_loop(random, plant, 1 + trial % 4, Prefilter::full);
    loop.setting.tau_f = std::max(loop.setting.tau_f, 0.01);
    if (!is_stable(open_loop(loop))) continue;
    expect_identity(loop);
  }
}

/// The ideal derivative of the output keeps u free of impulses; the prefilter cancels the zero of the PI part.
TEST(Identity, OfThePiPrefilterWithoutFilter) {
  Random random(22);
  for (int trial = 0; trial < 60; ++trial) {
    const Loop loop = oracle::random_stable_loop(random, static_cast<Plant>(trial % 3), 0, Prefilter::pi);
    expect_identity(loop);
  }
}

}  // namespace
}  // namespace portrait::reference
