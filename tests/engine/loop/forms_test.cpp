#include "engine/loop/forms.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

void expect_same(const StandardForm& a, const StandardForm& b, double relative) {
  EXPECT_NEAR(a.Kc, b.Kc, relative * std::abs(b.Kc));
  if (std::isinf(b.Ti)) {
    EXPECT_EQ(a.Ti, b.Ti);
  } else {
    EXPECT_NEAR(a.Ti, b.Ti, relative * b.Ti);
  }
  EXPECT_NEAR(a.TD, b.TD, relative * b.TD);
}

TEST(ParallelForm, IsTheStandardFormMultipliedOut) {
  const ParallelForm p = parallel({.Kc = 2, .Ti = 8, .TD = 0.5});
  EXPECT_EQ(p.Kp, 2);
  EXPECT_EQ(p.Ki, 0.25);
  EXPECT_EQ(p.Kd, 1);
}

TEST(ParallelForm, LeadsBack) {
  for (const double Kc : {2.0, -2.0})
    for (const double Ti : {8.0, kInf})
      for (const double TD : {0.5, 0.0}) expect_same(standard(parallel({Kc, Ti, TD})), {Kc, Ti, TD}, 1e-15);
}

TEST(ParallelForm, NoIntegralGainIsAnInfiniteIntegralTimeForEitherSign) {
  for (const double Kp : {2.0, -2.0})
    for (const double Ki : {0.0, -0.0}) EXPECT_EQ(standard(ParallelForm{Kp, Ki, 1}).Ti, kInf);
}

/// Kc (1 + 1/(Ti s))(1 + TD s) = Kc (1 + TD/Ti) + Kc/(Ti s) + Kc TD s, exact in these numbers.
TEST(SeriesForm, IsMultipliedOut) {
  const StandardForm form = standard(SeriesForm{.Kc = 2, .Ti = 6, .TD = 2});  // [Huba2022 (52)]
  EXPECT_DOUBLE_EQ(form.Kc, 2 * 8.0 / 6);
  EXPECT_EQ(form.Ti, 8);
  EXPECT_EQ(form.TD, 1.5);
}

TEST(SeriesForm, StandardToSeriesAndBack) {
  RandomLoops random(1);
  for (int i = 0; i < 2000; ++i) {
    const double Ti = random.log_uniform(1e-6, 1e6);
    const StandardForm form{random.uniform(-3, 3), Ti, Ti * random.uniform(0, 0.25)};
    const auto there = series(form);
    ASSERT_TRUE(there);
    EXPECT_GE(there->Ti, there->TD * (1 - 1e-7));
    expect_same(standard(*there), form, 1e-15 * 8);
  }
}

TEST(SeriesForm, SeriesToStandardAndBack) {
  RandomLoops random(2);
  for (int i = 0; i < 2000; ++i) {
    const double Ti = random.log_uniform(1e-6, 1e6);
    const SeriesForm form{random.uniform(-3, 3), Ti, Ti * random.log_uniform(1e-20, 0.5)};
    const auto back = series(standard(form));  // [Huba2022 (53)]
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->Kc, form.Kc, 1e-14 * std::abs(form.Kc));
    EXPECT_NEAR(back->Ti, form.Ti, 1e-14 * form.Ti);
    EXPECT_NEAR(back->TD, form.TD, 1e-14 * form.TD);
  }
}

TEST(SeriesForm, ExistsFromFourDerivativeTimesOn) {
  const double TD = 0.3, Ti = 4 * TD;
  const auto just = series(StandardForm{1, Ti, TD});
  ASSERT_TRUE(just);
  EXPECT_DOUBLE_EQ(just->Ti, just->TD);
  EXPECT_FALSE(series(StandardForm{1, std::nextafter(Ti, 0), TD}));
  EXPECT_FALSE(series(StandardForm{1, 1, 10}));
  EXPECT_TRUE(series(StandardForm{1, 1, 0}));
}

/// Ti_s TD_s = Ti TD and Ti_s + TD_s = Ti: the short time is TD (1 + TD/Ti + ...), which a difference of the
/// two nearly equal terms of (53) would lose.
TEST(SeriesForm, LosesNoDigitsOfAShortDerivativeTime) {
  const auto form = series(StandardForm{1, 1e6, 1e-6});
  ASSERT_TRUE(form);
  EXPECT_NEAR(form->TD, 1e-6 * (1 + 1e-12), 3e-22);
}

TEST(SeriesForm, WithoutIntegralActionIsTheStandardForm) {
  const auto form = series(StandardForm{-2, kInf, 3});
  ASSERT_TRUE(form);
  EXPECT_EQ(form->Kc, -2);
  EXPECT_EQ(form->Ti, kInf);
  EXPECT_EQ(form->TD, 3);
  expect_same(standard(*form), {-2, kInf, 3}, 0);
}

}  // namespace
}  // namespace portrait
