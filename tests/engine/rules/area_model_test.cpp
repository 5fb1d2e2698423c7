#include "engine/rules/area_model.h"

#include <gtest/gtest.h>

namespace portrait::rules {
namespace {

Areas areas(const AreaModel& m) { return areas_of(Polynomial{m.K, m.K * m.b1}, {1, m.a1, m.a2}, m.Td, 5); }

void expect_model(const std::optional<AreaModel>& found, const AreaModel& expected, double tolerance) {
  ASSERT_TRUE(found.has_value());
  const double T = expected.a1 + expected.Td + std::abs(expected.b1);
  EXPECT_NEAR(found->K, expected.K, std::abs(expected.K) * 1e-12);
  EXPECT_NEAR(found->Td, expected.Td, tolerance * T);
  EXPECT_NEAR(found->b1, expected.b1, tolerance * T);
  EXPECT_NEAR(found->a1, expected.a1, tolerance * T);
  EXPECT_NEAR(found->a2, expected.a2, tolerance * T * T);
}

TEST(AreaModel, WithoutZeroComesBack) {
  for (const AreaModel& m : {AreaModel{2, 0, 0.3, 1.4, 0.4}, AreaModel{-8.5, 0, 0.0179, 0.1081, 0.0035},
                             AreaModel{1e-3, 0, 200, 900, 2e5}})
    expect_model(model_without_zero(areas(m)), m, 1e-8);
}

/// First-order and pure delay plants give coinciding roots, of which rounding leaves a third or half of the digits.
TEST(AreaModel, PlantsOfLowerOrderComeBack) {
  expect_model(model_without_zero(areas({1, 0, 1, 0, 0})), {1, 0, 1, 0, 0}, 2e-5);
  expect_model(model_without_zero(areas({1, 0, 0.5, 2, 0})), {1, 0, 0.5, 2, 0}, 1e-6);
}

TEST(AreaModel, WithZeroComesBackByDeadTimeAndByPhase) {
  const AreaModel inverse{1, -2, 0.4, 2, 1}, leading{1, 0.7, 0.6, 1.5, 0.5};
  for (const AreaModel& m : {inverse, leading}) {
    expect_model(model_with_dead_time(areas(m), m.Td), m, 1e-10);
    expect_model(model_with_zero(areas(m), m.b1 > 0), m, 1e-7);
  }
}

TEST(AreaModel, WhateverIsFoundHasTheAreasOfThePlant) {
  for (int n = 3; n <= 8; ++n) {
    Polynomial D{1};
    for (int i = 0; i < n; ++i) D = product(D, {1, 1.0 / n});
    const Areas A = areas_of(Polynomial{1}, D, 0, 5);
    const auto model = model_with_zero(A, true);
    ASSERT_TRUE(model.has_value()) << n;
    const Areas back = areas(*model);
    for (std::size_t i = 0; i < (model->b1 == 0 ? 4u : 5u); ++i) EXPECT_NEAR(back[i], A[i], 1e-6) << n << " " << i;
  }
}

}  // namespace
}  // namespace portrait::rules
