#include "engine/rules/field.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/loop/margins.h"

namespace portrait::rules {
namespace {

/// An ultimate gain leaves a P controller no gain margin beyond it.
TEST(Field, UltimateGainIsTheGainMarginOfUnitGain) {
  for (const double T : {0.2, 1.0, 10.0}) {
    const Ultimate u = ultimate(LagDelayPlant{1, T, 1});
    Loop loop{{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.5, .tau_1 = T}};
    EXPECT_NEAR(0.5 * margins(open_loop(loop)).gain, u.gain, 1e-9 * u.gain);
  }
  EXPECT_NEAR(ultimate(IntegratingPlant{2, 0.5}).gain, std::numbers::pi / 2, 1e-15);
  // A lag much longer than the dead time is an integrator of velocity gain K/T.
  EXPECT_NEAR(ultimate(LagDelayPlant{1e6, 1e6, 1}).gain, ultimate(IntegratingPlant{1, 1}).gain, 1e-6);
}

/// For long lags every rule for lags tends to its rule for integrators (AMIGO to the digits its authors give).
TEST(Field, RulesForLagsTendToThoseForIntegrators) {
  const LagDelayPlant lag{1e7, 1e7, 1};
  const IntegratingPlant integrator{1, 1};
  const auto expect = [](const StandardForm& a, const StandardForm& b, double tolerance) {
    EXPECT_NEAR(a.Kc, b.Kc, tolerance * b.Kc);
    EXPECT_NEAR(a.Ti, b.Ti, tolerance * b.Ti);
    EXPECT_NEAR(a.TD, b.TD, tolerance);
  };
  expect(simc_pi(lag, 1), simc_pi(integrator, 1), 1e-6);
  expect(standard(isimc_pid(lag, 0.5)), standard(isimc_pid(integrator, 0.5)), 1e-6);
  expect(amigo_pi(lag), amigo_pi(integrator), 4e-3);
  expect(amigo_pid(lag), amigo_pid(integrator), 1e-6);
}

/// 1/(4 k (Tc + tau)^2): two integrators, so the time enters the gain squared.
TEST(Field, SimcOfTwoIntegrators) {
  const SeriesForm form = simc_double_integrator(2, 0.5, 0.5);
  EXPECT_DOUBLE_EQ(form.Kc, 1.0 / 8);
  EXPECT_DOUBLE_EQ(form.Ti, 4);
  EXPECT_DOUBLE_EQ(form.TD, 4);
}

}  // namespace
}  // namespace portrait::rules
