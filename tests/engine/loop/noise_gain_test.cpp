/// On real loops tests/engine/reference/noise_gain_test.cpp compares with simulated pulses.

#include "engine/loop/noise_gain.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/loop/open_loop.h"
#include "engine/loop/parameters.h"
#include "tests/engine/loop/random_loops.h"
#include "tests/oracle/quadrature.h"

namespace portrait {
namespace {

/// kappa so small that the loop is open: the controller alone answers the noise.
constexpr double kTiny = 1e-12;

TEST(NoiseGain, OfAnOpenProportionalControllerIsItsGain) {
  for (const double sampling : {1e-3, 0.1, 1.0, 2.5, 30.0})
    EXPECT_NEAR(noise_gain({{Plant::fotd, 0, Prefilter::none}, {.kappa = kTiny, .tau_1 = 3}}, sampling), kTiny,
                1e-9 * kTiny)
        << sampling;
}

/// h(t) = kappa (1 + (r - 1) e^{-t/tau_f}), r = tau_d/tau_f: the variance of a held pulse's answer, piece by piece.
double filtered_pd(double ratio, double tau_f, double sampling) {
  const double lead = ratio - 1, e = std::exp(-sampling / tau_f);
  const double during = sampling + 2 * lead * tau_f * (1 - e) + lead * lead * tau_f / 2 * (1 - e * e);
  const double after = lead * lead * tau_f / 2 * (1 - e) * (1 - e);
  return std::sqrt((during + after) / sampling);
}

TEST(NoiseGain, OfAnOpenFilteredPDControllerIsKnown) {
  for (const double tau_f : {1e-3, 0.1, 2.0})
    for (const double ratio : {0.0, 1.0, 5.0, 100.0})
      for (const double sampling : {0.01, 1.0, 3.7}) {
        const Loop loop{{Plant::fotd, 1, Prefilter::none},
                        {.kappa = kTiny, .delta = kTiny * ratio * tau_f, .tau_1 = 3, .tau_f = tau_f}};
        const double expected = kTiny * filtered_pd(ratio, tau_f, sampling);
        EXPECT_NEAR(noise_gain(loop, sampling), expected, 1e-8 * expected)
            << simulate_command(loop) << " --sampling " << sampling;
      }
}

/// Plain Gauss panels along the real axis, where the filter makes the rest beyond 2000 negligible.
TEST(NoiseGain, IsTheIntegralOverAllFrequencies) {
  const oracle::GaussRule rule = oracle::gauss_rule(24);
  RandomLoops random(70);
  for (int i = 0; i < 20;) {
    Loop loop = random.next_stable();
    if (loop.family.n < 3 || loop.setting.tau_f < 0.05) continue;
    const double sampling = random.log_uniform(0.02, 5);
    const OpenLoop open = open_loop(loop);
    const auto density = [&](double omega) {
      const std::complex<double> L = response_at(open, omega), jw(0, omega);
      const std::complex<double> delayed = std::exp(-jw);
      std::complex<double> plant = delayed;
      if (loop.family.plant == Plant::fotd) plant /= 1.0 + loop.setting.tau_1 * jw;
      for (int k = 0; k < integrators(loop.family.plant); ++k) plant /= jw;
      const double hold = std::sin(omega * sampling / 2) / (omega * sampling / 2);
      return std::norm(L / plant / (1.0 + L)) * sampling * hold * hold;
    };
    double sum = 0, from = 0;
    for (double to = 1e-6; from < 2000; from = to, to = std::min(1.02 * to, to + 0.1))
      sum += oracle::integral(rule, from, to, density);
    const double expected = std::sqrt(sum / std::numbers::pi);
    EXPECT_NEAR(noise_gain(loop, sampling), expected, 1e-8 * expected)
        << simulate_command(loop) << " --sampling " << sampling;
    ++i;
  }
}

TEST(NoiseGain, OfAnIdealDerivativeIsInfinite) {
  EXPECT_EQ(noise_gain({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.3, .delta = 0.1}}, 0.1), kInf);
  EXPECT_LT(noise_gain({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.3}}, 0.1), 1);
}

/// s + kappa e^{-s} near its limit: the peak is some 1e-8 wide, and the gain grows as its root.
TEST(NoiseGain, FindsAPeakHoweverNarrow) {
  const auto at = [](double distance) {
    return noise_gain({{Plant::ipdt, 0, Prefilter::none}, {.kappa = std::numbers::pi / 2 * (1 - distance)}}, 1);
  };
  EXPECT_NEAR(at(1e-6) / at(1e-4), 10, 0.01);
  EXPECT_NEAR(at(1e-8) / at(1e-6), 10, 1e-3);
}

TEST(NoiseGain, RefusesASamplingTimeThatIsNone) {
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.3}};
  for (const double sampling : {0.0, -1.0, kInf, kNaN}) EXPECT_THROW(noise_gain(loop, sampling), BrokenPromise);
}

}  // namespace
}  // namespace portrait
