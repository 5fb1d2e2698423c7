#include "engine/rules/reaction_curve.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/rules/step_response_rules.h"

namespace portrait::rules {
namespace {

TEST(ReactionCurve, EqualLagsInClosedForm) {
  const auto two = reaction_curve({3}, {1, 2, 1}, 0.7);  // slope t e^{-t}, steepest at t = 1
  EXPECT_NEAR(two->slope, 3 * std::exp(-1.0), 1e-11);
  EXPECT_NEAR(two->steepest_at, 1.7, 1e-7);
  EXPECT_NEAR(two->lag, 1 - (1 - 2 * std::exp(-1.0)) / std::exp(-1.0) + 0.7, 1e-10);
  const auto one = reaction_curve({-2}, {1, 4}, 1.5);  // steepest at the start
  EXPECT_NEAR(one->slope, -0.5, 1e-14);
  EXPECT_NEAR(one->lag, 1.5, 1e-14);
}

TEST(ReactionCurve, AnIntegratorReachesItsSlopeInTheEnd) {
  const auto curve = reaction_curve({2}, {0, 1, 3}, 0.5);  // 2/(s (1 + 3 s)): slope 2, late by 3
  EXPECT_NEAR(curve->slope, 2, 1e-11);
  EXPECT_NEAR(curve->lag, 3.5, 1e-9);
}

TEST(ReactionCurve, WhatGrowsForEverHasNone) { EXPECT_FALSE(reaction_curve({1}, {0, 0, 1}, 1).has_value()); }

TEST(SteepestTangent, DeadTimeAlone) { EXPECT_EQ(steepest_tangent({1}, {1}, 2)->T, 0); }

}  // namespace
}  // namespace portrait::rules
