#include "engine/rules/pareto_pi.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/loop.h"

namespace portrait::rules {
namespace {

/// J at Ms along the front, apart from the search.
double J_at(const PiLoop& loop, const ParetoPi& found, double cbar, double s_r, double Ms = 1.59) {
  const auto form = pi_of_sensitivity(loop, cbar, Ms);
  const PiErrors e = loop.errors(form->Kc, form->Ti);
  return s_r * e.IAE_vy / found.least.IAE_vy + (1 - s_r) * e.IAE_vu / found.least.IAE_vu;
}

TEST(ParetoPi, IntegratorMeetsMsAndTheFrontIsHigherOnBothSides) {
  const PiLoop loop = pi_loop(IntegratingPlant{1, 1});
  const auto found = pareto_pi(loop, 1.59, 0.5);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(loop.Ms(found->Kp, found->Ti), 1.59, 1e-9);
  // The slope vanishes: a step of h to either side raises J by the same, 0.0006 of h of the width of the valley.
  const double left = J_at(loop, *found, found->cbar * std::exp(-0.05), 0.5) - found->J;
  const double right = J_at(loop, *found, found->cbar * std::exp(0.05), 0.5) - found->J;
  EXPECT_GT(left, 0);
  EXPECT_GT(right, 0);
  EXPECT_NEAR(left, right, 0.05 * left);
  EXPECT_NEAR(found->Kp, 0.40994, 2e-5);
  EXPECT_NEAR(found->Ti, 6.27372, 5e-5);
}

TEST(ParetoPi, WeightsOfAnotherMsGiveAnotherOptimum) {
  const PiLoop loop = pi_loop(IntegratingPlant{1, 1});
  const PiErrors weights{2.17, 15.10};
  const auto own = pareto_pi(loop, 1.3, 0.5), given = pareto_pi(loop, 1.3, 0.5, weights);
  ASSERT_TRUE(own && given);
  EXPECT_EQ(given->least.IAE_vy, weights.IAE_vy);
  EXPECT_EQ(given->least.IAE_vu, weights.IAE_vu);
  // The slow loops of this Ms have a larger IAE_vu yet: weighed against that of 1.59, less of it is worth more.
  EXPECT_LT(given->cbar, 0.97 * own->cbar);
  EXPECT_GT(J_at(loop, *given, given->cbar * std::exp(-0.05), 0.5, 1.3), given->J);
  EXPECT_GT(J_at(loop, *given, given->cbar * std::exp(0.05), 0.5, 1.3), given->J);
  EXPECT_NEAR(pareto_pi(loop, 1.3, 0.5, own->least)->J, own->J, 1e-12);
}

TEST(ParetoPi, ScalesWithThePlant) {
  const auto unit = pareto_pi(pi_loop(LagDelayPlant{1, 5, 1}), 1.7, 0.5);
  const auto real = pareto_pi(pi_loop(LagDelayPlant{-3, 0.5, 0.1}), 1.7, 0.5);
  ASSERT_TRUE(unit && real);
  EXPECT_NEAR(real->Kp * -3 / unit->Kp, 1, 1e-6);
  EXPECT_NEAR(real->Ti * 10 / unit->Ti, 1, 1e-6);
  EXPECT_NEAR(real->J, unit->J, 1e-9);
}

TEST(ParetoPi, NoPiIsCalmerThanItsPlantAllows) {
  EXPECT_FALSE(pi_of_sensitivity(pi_loop(IntegratingPlant{1, 1}), 1.0, 1.05).has_value());
}

}  // namespace
}  // namespace portrait::rules
