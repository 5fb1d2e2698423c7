#include "engine/rules/model_based.h"

#include <cmath>

#include <gtest/gtest.h>

namespace portrait::rules {
namespace {

/// (2) with the quotient itself in place of the dead time: R F/(1 + R F) is the target then, to the last bit that counts.
TEST(ModelBased, ClosesTheLoopOnItsTarget) {
  for (int j = 0; j <= 5; ++j)
    for (const DeadTimeQuotient q :
         {DeadTimeQuotient::taylor, DeadTimeQuotient::pade_1, DeadTimeQuotient::pade_2}) {
      const LagPlant plant{j, 2.5, 1.3, 0.8};
      constexpr double kTc = 0.6;
      const Quotient R = model_based_controller(plant, kTc, q);
      for (const double s : {0.1, 0.7, 3.0}) {
        const double E = q == DeadTimeQuotient::taylor ? 1 - 0.8 * s
                         : q == DeadTimeQuotient::pade_1
                             ? (1 - 0.4 * s) / (1 + 0.4 * s)
                             : (1 - 0.4 * s + 0.64 * s * s / 12) / (1 + 0.4 * s + 0.64 * s * s / 12);
        const double L = value(R.numerator, s) / value(R.denominator, s) * 2.5 * E / std::pow(1 + 1.3 * s, j);
        EXPECT_NEAR(L / (1 + L), E / std::pow(1 + kTc * s, std::max(j, 1)), 1e-12) << j;
      }
      EXPECT_EQ(R.denominator[0], 0);
      EXPECT_LE(R.numerator.size(), R.denominator.size());
    }
}

/// (12): K_c = T1/(K (Tc + Td)), TD = Td/2, T_f1 = Tc Td/(2 (Tc + Td)).
TEST(ModelBased, FirstOrderPadeIsThePidOfThePaper) {
  const Quotient R = model_based_controller({1, 1, 1.1, 1.1}, 0.7, DeadTimeQuotient::pade_1);
  const double Kc = 1.1 / 1.8, Ti = 1.1, TD = 0.55, Tf = 0.7 * 1.1 / (2 * 1.8);
  for (const double s : {0.2, 1.0, 5.0})
    EXPECT_NEAR(value(R.numerator, s) / value(R.denominator, s),
                Kc * (1 + 1 / (Ti * s)) * (1 + TD * s) / (1 + Tf * s), 1e-12);
}

TEST(ModelBased, Prefilters) {
  const LagPlant plant{3, 1, 2, 1};
  EXPECT_EQ(smooth_prefilter(plant, 2).denominator, (Polynomial{1, 4, 4}));
  EXPECT_EQ(step_prefilter(plant, 1).numerator, (Polynomial{1, 3, 3, 1}));
  EXPECT_EQ(step_prefilter(plant, 1).denominator, (Polynomial{1, 6, 12, 8}));
}

}  // namespace
}  // namespace portrait::rules
