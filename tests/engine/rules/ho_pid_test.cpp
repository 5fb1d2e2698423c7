#include <complex>

#include <gtest/gtest.h>

#include "engine/rules/magnitude_optimum.h"

namespace portrait::rules {
namespace {

std::complex<double> at(const Polynomial& p, std::complex<double> s) {
  std::complex<double> sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * s + p[i];
  return sum;
}

/// What the rule promises: Re L(jw) = -1/2 up to a power of w that rises with m.
TEST(MagnitudeOptimum, RealPartOfTheOpenLoopIsFlat) {
  const Polynomial N{2, 0.8}, D{1, 3.2, 2.7, 0.6};
  constexpr double kTd = 0.4, kTf = 0.1;
  for (int m = 0; m <= 3; ++m) {
    const int n = m + 1;
    const auto gains = magnitude_optimum(filtered(areas_of(N, D, kTd, 20), kTf, n), m);
    ASSERT_TRUE(gains.has_value());
    const auto deviation = [&](double w) {
      const std::complex<double> s(0, w);
      const std::complex<double> L =
          at(*gains, s) / s / std::pow(1.0 + kTf * s, n) * at(N, s) / at(D, s) * std::exp(-kTd * s);
      return std::abs(L.real() + 0.5);
    };
    // Halving w divides the deviation by 2^(2m + 4).
    const double order = std::log2(deviation(0.2) / deviation(0.1));
    EXPECT_NEAR(order, 2 * m + 4, 0.5) << m;
  }
}

TEST(MagnitudeOptimum, ScalesWithGainAndTime) {
  const Areas A = filtered(areas_of(Polynomial{1}, {1, 2, 1}, 0.5, 8), 0.1, 2);
  Areas scaled = A;
  double T = 1;
  for (double& a : scaled) a *= 4 * T, T *= 1e-3;
  const auto plain = magnitude_optimum(A, 2), changed = magnitude_optimum(scaled, 2);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR((*changed)[static_cast<std::size_t>(i)] * 4 * std::pow(1e-3, 1 - i),
                (*plain)[static_cast<std::size_t>(i)], 1e-10);
}

TEST(MagnitudeOptimum, AControllerThatCouldCancelThePlantHasNoOptimum) {
  EXPECT_FALSE(magnitude_optimum(areas_of(Polynomial{1}, {1, 2, 1}, 0, 6), 1).has_value());
  EXPECT_TRUE(magnitude_optimum(areas_of(Polynomial{1}, {1, 2, 1}, 0, 4), 0).has_value());
}

TEST(MagnitudeOptimum, NoiseGainIsMetAtTheFixedPoint) {
  const Areas A = areas_of(Polynomial{1}, {1, 3, 3, 1}, 0.5, 10);
  const auto found = magnitude_optimum_for_noise_gain(A, 3, 4, 10, 0.002);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->Tf, 0.123995, 5e-7);
  const auto again = magnitude_optimum(filtered(A, found->Tf, 4), 3);
  for (std::size_t i = 0; i < again->size(); ++i) EXPECT_NEAR((*again)[i], found->gains[i], 1e-10);
}

}  // namespace
}  // namespace portrait::rules
