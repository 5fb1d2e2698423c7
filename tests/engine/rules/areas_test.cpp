#include "engine/rules/areas.h"

#include <gtest/gtest.h>

namespace portrait::rules {
namespace {

void expect_near(const Areas& found, const Areas& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance * std::abs(expected[i])) << i;
}

/// Maclaurin coefficients taken with mpmath: 2 (1 + 0.6 s - 0.2 s^2)/(1 + 3.1 s + 2.2 s^2 + 0.7 s^3) e^{-0.35 s}.
TEST(Areas, OfZerosPolesAndDelay) {
  const Areas A = areas_of(Polynomial{2, 1.2, -0.4}, {1, 3.1, 2.2, 0.7}, 0.35, 10);
  expect_near(A,
              {2, 5.7, 12.5725, 27.635542, 61.968855, 140.102487, 317.330810, 718.878219, 1628.466436, 3688.845436},
              1e-7);
}

/// The moments of a dead time are powers over factorials, those of equal lags binomials.
TEST(Areas, ClosedForms) {
  expect_near(areas_of(Polynomial{1}, {1}, 2.0, 5), {1, 2, 2, 8.0 / 6, 16.0 / 24}, 1e-15);
  expect_near(areas_of(Polynomial{1}, {1, 4, 6, 4, 1}, 0, 6), {1, 4, 10, 20, 35, 56}, 1e-15);
}

TEST(Areas, FilterBehindThePlantIsAFilterInThePlant) {
  const Areas apart = filtered(areas_of(Polynomial{3}, {1, 2}, 0.7, 8), 0.25, 3);
  const Polynomial lag{1, 0.25};
  expect_near(apart, areas_of(Polynomial{3}, product(product(product({1, 2}, lag), lag), lag), 0.7, 8), 1e-14);
}

}  // namespace
}  // namespace portrait::rules
