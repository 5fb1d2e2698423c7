/// The reference simulation against formulas worked out by hand for the first dead times.
///
/// t is the time, x the time since the last multiple of the dead time, E = e^{-x/T} with the T named beside it.

#include <cmath>
#include <complex>
#include <functional>

#include <gtest/gtest.h>

#include "engine/reference/response.h"

namespace portrait::reference {
namespace {

constexpr double kTolerance = 1e-12;
using Formula = std::function<double(double)>;
using Signal = double (*)(const StepResponse&, double);

/// From `from` up to but not including the next dead time; formula of x = t - from.
void expect_formula(const StepResponse& response, Signal signal, double from, const Formula& formula) {
  for (int i = 0; i < 40; ++i) {
    const double x = i / 40.0;
    EXPECT_NEAR(signal(response, from + x), formula(x), kTolerance) << "t = " << from + x;
  }
}

Response first_intervals(Plant plant, int n, Prefilter prefilter, const Setting& setting) {
  return simulate({{plant, n, prefilter}, setting}, Horizon::fixed(3));
}

TEST(FirstIntervals, NothingMovesYInTheFirstDeadTime) {
  const auto r =
      first_intervals(Plant::ipdt, 1, Prefilter::full, {.kappa = 0.4, .tau_i = 6, .delta = 0.2, .tau_f = 0.3});
  for (const Step step : kUsualSteps) expect_formula(r.steps[step], y_at, 0, [](double) { return 0; });
}

TEST(FirstIntervals, IpdtP) {
  const double kappa = 0.7;
  const auto r = first_intervals(Plant::ipdt, 0, Prefilter::none, {.kappa = kappa});
  const StepResponse& w = r.steps[kSetpoint];
  expect_formula(w, u_at, 0, [&](double) { return kappa; });
  expect_formula(w, y_at, 1, [&](double x) { return kappa * x; });
  expect_formula(w, y_at, 2, [&](double x) { return kappa * (1 + x) - kappa * kappa * x * x / 2; });
  const StepResponse& d = r.steps[kDisturbance];
  expect_formula(d, u_at, 0, [](double) { return 0; });
  expect_formula(d, u_at, 1, [&](double x) { return -kappa * x; });
  expect_formula(d, y_at, 1, [](double x) { return x; });
  expect_formula(d, y_at, 2, [&](double x) { return 1 + x - kappa * x * x / 2; });
}

/// The ideal derivative on one integrator: y' jumps, and with it u, at every dead time.
TEST(FirstIntervals, IpdtPdIsNeutral) {
  const double kappa = 0.7, delta = 0.4;
  const auto r = first_intervals(Plant::ipdt, 0, Prefilter::none, {.kappa = kappa, .delta = delta});
  const StepResponse& w = r.steps[kSetpoint];
  expect_formula(w, u_at, 1, [&](double x) { return kappa - kappa * kappa * x - delta * kappa; });
  expect_formula(w, y_at, 2, [&](double x) { return kappa + kappa * (1 - delta) * x - kappa * kappa * x * x / 2; });
  const StepResponse& d = r.steps[kDisturbance];
  expect_formula(d, u_at, 1, [&](double x) { return -kappa * x - delta; });
  expect_formula(d, u_at, 2, [&](double x) {
    const double y = 1 + (1 - delta) * x - kappa * x * x / 2, slope = 1 - delta - kappa * x;
    return -kappa * y - delta * slope;
  });
}

TEST(FirstIntervals, DipdtPd) {
  const double kappa = 0.08, delta = 0.46;
  const auto r = first_intervals(Plant::dipdt, 0, Prefilter::none, {.kappa = kappa, .delta = delta});
  const StepResponse& w = r.steps[kSetpoint];
  expect_formula(w, y_at, 1, [&](double x) { return kappa * x * x / 2; });
  expect_formula(w, u_at, 1, [&](double x) { return kappa - kappa * kappa * x * x / 2 - delta * kappa * x; });
  expect_formula(w, y_at, 2, [&](double x) {
    return kappa * (0.5 + x + x * x / 2 - kappa * std::pow(x, 4) / 24 - delta * std::pow(x, 3) / 6);
  });
  const StepResponse& d = r.steps[kDisturbance];
  expect_formula(d, y_at, 1, [](double x) { return x * x / 2; });
  expect_formula(d, u_at, 1, [&](double x) { return -kappa * x * x / 2 - delta * x; });
}

/// T = tau_f. The filter's answers to 1, t, t^2/2 are F1', F2', F3' with F1 .. F3 integrated once, twice, three times.
TEST(FirstIntervals, DipdtPidWithFirstOrderFilter) {
  const double kappa = 0.12, delta = 0.5, tau_i = 10, T = 0.07;
  const auto r = first_intervals(Plant::dipdt, 1, Prefilter::none,
                                 {.kappa = kappa, .tau_i = tau_i, .delta = delta, .tau_f = T});
  const auto E = [&](double x) { return std::exp(-x / T); };
  const auto F1 = [&](double x) { return x - T * (1 - E(x)); };
  const auto F2 = [&](double x) { return x * x / 2 - T * x + T * T * (1 - E(x)); };
  const auto F3 = [&](double x) { return x * x * x / 6 - T * x * x / 2 + T * T * x - T * T * T * (1 - E(x)); };
  const StepResponse& w = r.steps[kSetpoint];
  expect_formula(w, u_at, 0,
                 [&](double x) { return kappa * (1 - E(x)) + delta * E(x) / T + kappa / tau_i * F1(x); });
  expect_formula(w, y_at, 1, [&](double x) { return kappa * F2(x) + delta * F1(x) + kappa / tau_i * F3(x); });
  const StepResponse& d = r.steps[kDisturbance];
  expect_formula(d, y_at, 1, [](double x) { return x * x / 2; });
  expect_formula(d, u_at, 1, [&](double x) { return -kappa * F2(x) - delta * F1(x) - kappa / tau_i * F3(x); });
}

/// T = tau_f: (1 - (1 + x/T) E) is the double lag's step response.
TEST(FirstIntervals, IpdtPWithSecondOrderFilter) {
  const double kappa = 0.5, T = 0.3;
  const auto r = first_intervals(Plant::ipdt, 2, Prefilter::none, {.kappa = kappa, .tau_f = T});
  expect_formula(r.steps[kSetpoint], u_at, 0,
                 [&](double x) { return kappa * (1 - (1 + x / T) * std::exp(-x / T)); });
  expect_formula(r.steps[kSetpoint], y_at, 1,
                 [&](double x) { return kappa * (x - 2 * T + (x + 2 * T) * std::exp(-x / T)); });
}

/// T = tau_1
TEST(FirstIntervals, FotdP) {
  const double kappa = 0.8, T = 1.7;
  const auto r = first_intervals(Plant::fotd, 0, Prefilter::none, {.kappa = kappa, .tau_1 = T});
  const auto E = [&](double x) { return std::exp(-x / T); };
  const StepResponse& w = r.steps[kSetpoint];
  expect_formula(w, y_at, 1, [&](double x) { return kappa * (1 - E(x)); });
  expect_formula(w, u_at, 1, [&](double x) { return kappa - kappa * kappa * (1 - E(x)); });
  expect_formula(w, y_at, 2, [&](double x) {
    return kappa * (1 - kappa) * (1 - E(x)) + kappa * kappa * x / T * E(x) + kappa * (1 - E(1)) * E(x);
  });
  const StepResponse& d = r.steps[kDisturbance];
  expect_formula(d, y_at, 1, [&](double x) { return 1 - E(x); });
  expect_formula(d, y_at, 2,
                 [&](double x) { return (1 - kappa) * (1 - E(x)) + kappa * x / T * E(x) + (1 - E(1)) * E(x); });
}

/// T = tau_1
TEST(FirstIntervals, FotdPi) {
  const double kappa = 0.8, T = 1.7, tau_i = 2.2, k = kappa / tau_i;
  const auto r = first_intervals(Plant::fotd, 0, Prefilter::none, {.kappa = kappa, .tau_i = tau_i, .tau_1 = T});
  const auto lag = [&](double x) { return 1 - std::exp(-x / T); };
  const auto y = [&](double x) { return kappa * lag(x) + k * (x - T * lag(x)); };
  const auto y_integral = [&](double x) {
    return kappa * (x - T * lag(x)) + k * (x * x / 2 - T * x + T * T * lag(x));
  };
  const StepResponse& w = r.steps[kSetpoint];
  expect_formula(w, u_at, 0, [&](double x) { return kappa + k * x; });
  expect_formula(w, y_at, 1, y);
  expect_formula(w, u_at, 1, [&](double x) { return kappa * (1 - y(x)) + k * (1 + x - y_integral(x)); });
  const StepResponse& d = r.steps[kDisturbance];
  expect_formula(d, y_at, 1, lag);
  expect_formula(d, u_at, 1, [&](double x) { return -kappa * lag(x) - k * (x - T * lag(x)); });
}

/// The prefilter `pi` and a PI controller: (kappa/tau_i) (1 + b tau_i s)/s^2, a jump and a ramp.
TEST(FirstIntervals, PrefilterPi) {
  const double kappa = 0.3, tau_i = 5;
  for (const double b : {0.0, 0.4, 1.0, 1.5}) {
    const auto r =
        first_intervals(Plant::dipdt, 0, Prefilter::pi, {.kappa = kappa, .tau_i = tau_i, .delta = 0.4, .b = b});
    expect_formula(r.steps[kSetpoint], u_at, 0, [&](double x) { return kappa * (b + x / tau_i); });
  }
}

TEST(FirstIntervals, PrefilterPiWithoutIntegralActionIsNone) {
  const auto r = first_intervals(Plant::ipdt, 0, Prefilter::pi, {.kappa = 0.3, .b = 0.5});
  expect_formula(r.steps[kSetpoint], u_at, 0, [](double) { return 0.3; });
}

/// r through poles p1, p2 of the prefilter: 1 + A1 e^{p1 t} + A2 e^{p2 t} with A1 = (1 + b p1 + c p1^2)/(a2 p1 (p1 -
/// p2)), then u = kappa r + (kappa/tau_i) int r, which is exact for n = 0.
void expect_full_prefilter(const Setting& s) {
  using Complex = std::complex<double>;
  const double a1 = s.tau_i, a2 = s.tau_i * tau_d(s);
  const Complex root = std::sqrt(Complex(a1 * a1 - 4 * a2));
  const Complex p[] = {(-a1 + root) / (2 * a2), (-a1 - root) / (2 * a2)};
  const auto u = [&](double t) {
    Complex r = 1, integral = t;
    for (int i = 0; i < 2; ++i) {
      const Complex A = (1.0 + s.b * p[i] + s.c * p[i] * p[i]) / (a2 * p[i] * (p[i] - p[1 - i]));
      r += A * std::exp(p[i] * t);
      integral += A * (std::exp(p[i] * t) - 1.0) / p[i];
    }
    return s.kappa * (r + integral / s.tau_i).real();
  };
  const auto response = first_intervals(Plant::dipdt, 0, Prefilter::full, s);
  expect_formula(response.steps[kSetpoint], u_at, 0, u);
}

TEST(FirstIntervals, PrefilterFullWithRealPoles) {
  expect_full_prefilter({.kappa = 0.5, .tau_i = 8, .delta = 0.6});
  expect_full_prefilter({.kappa = 0.5, .tau_i = 8, .delta = 0.6, .b = 3});
  expect_full_prefilter({.kappa = 0.5, .tau_i = 8, .delta = 0.6, .b = 3, .c = 2});
}

TEST(FirstIntervals, PrefilterFullWithComplexPoles) {
  expect_full_prefilter({.kappa = 0.125, .tau_i = 10, .delta = 0.5});
  expect_full_prefilter({.kappa = 0.125, .tau_i = 10, .delta = 0.5, .b = -1, .c = 4});
  expect_full_prefilter({.kappa = 0.5, .tau_i = 0.05, .delta = 0.5, .b = 0.1, .c = 0.01});
}

TEST(FirstIntervals, PrefilterFullOfAPdController) {
  const double kappa = 0.2, delta = 0.5, b = 1.2, T = delta / kappa;
  const auto r = first_intervals(Plant::dipdt, 0, Prefilter::full, {.kappa = kappa, .delta = delta, .b = b});
  expect_formula(r.steps[kSetpoint], u_at, 0,
                 [&](double x) { return kappa * (1 - (1 - b / T) * std::exp(-x / T)); });
}

TEST(FirstIntervals, PrefilterFullOfAPiController) {
  const double kappa = 0.2, tau_i = 4, b = 1.2;
  const auto r = first_intervals(Plant::ipdt, 0, Prefilter::full, {.kappa = kappa, .tau_i = tau_i, .b = b});
  expect_formula(r.steps[kSetpoint], u_at, 0, [&](double x) { return kappa * (b + x) / tau_i; });
}

}  // namespace
}  // namespace portrait::reference
