#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/loop/margins.h"
#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "engine/rules/delta_tuning.h"

namespace portrait::rules {
namespace {

OpenLoop pi_on_integrator(const StandardForm& form) {
  return open_loop(Loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = form.Kc, .tau_i = form.Ti}});
}

/// The paper's claim: delta tau is the delay margin exactly, for every method product.
TEST(DeltaTuning, DeltaIsTheDelayMargin) {
  for (const double cbar : {1.5, 2.0, 2.5, 2.7, 4.0, 30.0})
    for (const double delta : {0.3, 1.1, 1.6, 3.4}) {
      const StandardForm form = delta_tuning({1, 1}, cbar, delta);
      EXPECT_NEAR(margins(pi_on_integrator(form)).delay, delta, 1e-9);
      EXPECT_NEAR(form.Kc * form.Ti, cbar, 1e-12);
      EXPECT_NEAR(relative_delay_margin(form.Kc, form.Ti), delta, 1e-12);
    }
}

/// (49): PM = delta sqrt(f) alpha.
TEST(DeltaTuning, PhaseMargin) {
  const StandardForm form = delta_tuning({1, 1}, 2.5, 1.79);
  const double PM = 1.79 * std::sqrt(method_product_f(2.5)) * form.Kc * 180 / std::numbers::pi;
  EXPECT_NEAR(margins(pi_on_integrator(form)).phase_deg, PM, 1e-8);
}

TEST(DeltaTuning, WithoutDeadTime) {
  const StandardForm form = delta_tuning_by_margin({2, 0}, 2.5, 0.5), unit = delta_tuning_by_margin({1, 0}, 2.5, 1);
  EXPECT_NEAR(form.Kc, unit.Kc, 1e-15);
  EXPECT_NEAR(form.Ti, unit.Ti / 2, 1e-15);
}

/// At the root of (37) all three conditions (34)-(36) hold, elsewhere (34) and (36).
TEST(DeltaTuning, PadeConditions) {
  for (const double c : {1.4, pade_triple_root(), 2.5}) {
    const StandardForm form = pade_tuning({1, 1}, c);
    EXPECT_NEAR(c * c * c, form.Ti * (1.0 / 3 / form.Kc + 1.0 / 6), 1e-12);
    EXPECT_NEAR(3 * c, form.Ti - 2.0 / 3, 1e-12);
    const double rest = 3 * c * c - (1.0 / 6 - form.Ti * (2.0 / 3 - 1 / form.Kc));
    if (c == pade_triple_root())
      EXPECT_NEAR(rest, 0, 1e-11);
    else
      EXPECT_GT(std::abs(rest), 0.01);
  }
}

}  // namespace
}  // namespace portrait::rules
