#include "engine/loop/sensitivity.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/loop/forms.h"
#include "engine/loop/parameters.h"
#include "engine/loop/stability.h"
#include "tests/engine/loop/peak_scan.h"
#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

using std::numbers::pi;

double Ms(const Loop& loop) { return sensitivity_peak(open_loop(loop)).value; }
double Mt(const Loop& loop) { return complementary_sensitivity_peak(open_loop(loop)).value; }

Loop ideal_pid(const StandardForm& form) {
  return {{Plant::dipdt, 0, Prefilter::pi}, {.kappa = form.Kc, .tau_i = form.Ti, .delta = form.Kc * form.TD}};
}

/// A series controller as (49) prints it: delta is kappa_s tau_D.
StandardForm from_series(double kappa, double delta, double tau) {
  return standard(SeriesForm{.Kc = kappa, .Ti = tau, .TD = delta / kappa});
}

/// Printed to two decimals; with more of them our values are the second ones.
TEST(Sensitivity, OfTheSeriesSettingsIsTheOneTheyWereOptimisedFor) {  // [Huba2022 (49)]
  const auto expect = [](const Loop& loop, double published, double more_exactly) {
    EXPECT_NEAR(Ms(loop), published, 5e-3);
    EXPECT_NEAR(Ms(loop), more_exactly, 5e-5);
  };
  expect(ideal_pid(from_series(0.0354, 0.382, 10.74)), 1.59, 1.5905);
  expect(ideal_pid(from_series(0.0505, 0.4737, 9.37)), 1.80, 1.8010);
  expect(ideal_pid(from_series(0.0625, 0.5475, 8.64)), 2.00, 1.9995);
}

/// The printed delta_o are half of what (52) gives, so the peaks are more than twice as high as announced.
TEST(Sensitivity, OfTheConvertedSettingsAsPrintedIsAnother) {  // [Huba2022 (50)]
  const auto printed = [](double kappa, double delta, double tau_i) {
    return Ms({{Plant::dipdt, 0, Prefilter::pi}, {.kappa = kappa, .tau_i = tau_i, .delta = delta}});
  };
  EXPECT_NEAR(printed(0.0710, 0.1905, 21.5310), 3.86, 5e-3);
  EXPECT_NEAR(printed(0.1011, 0.2367, 18.7502), 4.25, 5e-3);
  EXPECT_NEAR(printed(0.1259, 0.2719, 17.4000), 4.59, 5e-3);
}

/// Where |L| grows towards its limit the supremum 1/(1 - |L(inf)|) is attained by no frequency.
TEST(Sensitivity, OfANeutralLoopMayBeALimit) {
  const Loop fotd{{Plant::fotd, 0, Prefilter::pi}, {.kappa = 0.02, .delta = 1.4, .tau_1 = 2}};
  const Peak peak = sensitivity_peak(open_loop(fotd));
  EXPECT_NEAR(peak.value, 1 / (1 - 0.7), 1e-12);
  EXPECT_EQ(peak.omega, kInf);
  EXPECT_NEAR(Mt(fotd), 0.7 / 0.3, 1e-12);
}

TEST(Sensitivity, OfANeutralLoopIsNeverBelowItsLimit) {
  for (const double delta : {0.01, 0.3, 0.9, 0.99}) {
    const Loop loop{{Plant::ipdt, 0, Prefilter::pi}, {.kappa = 0.01, .delta = delta}};
    ASSERT_TRUE(is_stable(open_loop(loop)));
    EXPECT_GE(Ms(loop), 1 / (1 - delta));
    EXPECT_GE(Mt(loop), delta / (1 - delta));
  }
}

/// P-control of ipdt below half the gain of the first wiggle: |T| falls from its limit 1 at rest.
TEST(ComplementarySensitivity, MayHaveItsSupremumAtRest) {
  const Loop slow{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.2}};
  const Peak peak = complementary_sensitivity_peak(open_loop(slow));
  EXPECT_EQ(peak.value, 1);
  EXPECT_EQ(peak.omega, 0);
  const Loop static_gain{{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.25, .tau_1 = 5}};
  EXPECT_DOUBLE_EQ(Mt(static_gain), 0.2);
}

/// s + kappa e^{-s} next to its limit pi/2: the peak is as narrow as the root is near.
TEST(Sensitivity, OfALoopAtTheEdgeOfStability) {
  for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = pi / 2 * (1 - distance)}};
    // On the axis near j pi/2, f = j (pi/2) distance + (j - pi/2) x: the nearest it comes to 0, and s there.
    const double expected = std::hypot(1, pi / 2) / (pi / 2) / distance;
    EXPECT_NEAR(Ms(loop), expected, expected * (3 * distance + 1e-8 / distance * 1e-7));
  }
}

void expect_as_scanned(const Loop& loop) {
  SCOPED_TRACE(simulate_command(loop));
  ASSERT_TRUE(is_stable(open_loop(loop)));
  const Peaks expected = peaks_by_scan(loop);
  EXPECT_NEAR(Ms(loop), expected.Ms, 1e-9 * expected.Ms);
  EXPECT_NEAR(Mt(loop), expected.Mt, 1e-9 * expected.Mt);
}

/// Closer to the edge than rounding can tell the search still comes to an end.
TEST(Sensitivity, OfALoopOnTheEdgeIsHuge) {
  for (const double distance : {1e-12, 1e-15, 0.0}) {
    const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = pi / 2 * (1 - distance)}};
    EXPECT_GT(Ms(loop), 1e11);
    EXPECT_GT(Mt(loop), 1e11);
  }
}

/// Little filter and much derivative: tens of narrow peaks, one a turn of the dead time, nearly of a height; the
/// first, broad one takes over as delta falls.
TEST(Sensitivity, FindsTheHighestOfManyNarrowPeaks) {
  Loop loop{{Plant::ipdt, 1, Prefilter::none}, {.kappa = 0.05, .tau_i = 50, .tau_f = 0.005}};
  for (const double delta : {0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95}) {
    loop.setting.delta = delta;
    expect_as_scanned(loop);
  }
}

TEST(Sensitivity, FindsTheHigherOfABroadAndANarrowPeak) {
  Loop loop{{Plant::ipdt, 1, Prefilter::none}, {.tau_i = 20, .delta = 0.6, .tau_f = 0.01}};
  for (double kappa = 0.05; kappa < 1; kappa += 0.025) {
    loop.setting.kappa = kappa;
    if (is_stable(open_loop(loop))) expect_as_scanned(loop);
  }
}

/// A little gain makes several peaks within one step of a coarse search.
TEST(Sensitivity, FindsThePeaksOfAWeakLoop) {
  expect_as_scanned(
      {{Plant::fotd, 2, Prefilter::none}, {.kappa = 0.047, .delta = 0.0031, .tau_1 = 0.041, .tau_f = 0.0044}});
  expect_as_scanned({{Plant::fotd, 1, Prefilter::none},
                     {.kappa = 0.00153, .tau_i = 1.915, .delta = 0.00175, .tau_1 = 0.1415, .tau_f = 0.0437}});
}

TEST(Sensitivity, TheFrequencyIsWhereThePeakIs) {
  RandomLoops random(30);
  for (int i = 0; i < 200; ++i) {
    const Loop loop = random.next_stable();
    const Peak peak = sensitivity_peak(open_loop(loop));
    if (std::isinf(peak.omega)) continue;
    const double there = 1 / std::abs(1.0 + open_loop_as_written(loop, peak.omega));
    EXPECT_NEAR(there, peak.value, 1e-11 * peak.value) << simulate_command(loop);
  }
}

/// A root of an increasing function between two points.
template <typename Function>
double root(Function f, double left, double right) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (left + right);
    (f(middle) < 0 ? left : right) = middle;
  }
  return left;
}

/// L = kappa e^{-s}/s: |1 + L|^2 and |1 + 1/L|^2 are stationary where these functions vanish.
TEST(Sensitivity, TheFrequencyOfAFlatPeakIsThatOfNoSlope) {
  for (const double kappa : {0.6, 0.9, 1.3}) {
    const OpenLoop open = open_loop({{Plant::ipdt, 0, Prefilter::none}, {.kappa = kappa}});
    const auto of_s = [&](double w) { return -(w * (w * std::cos(w) - std::sin(w)) + kappa); };
    const auto of_t = [&](double w) { return w - kappa * (std::sin(w) + w * std::cos(w)); };
    const double s = root(of_s, 1, 2.5), t = root(of_t, 0.2, 2.5);
    EXPECT_NEAR(sensitivity_peak(open).omega, s, 1e-9 * s) << kappa;
    EXPECT_NEAR(complementary_sensitivity_peak(open).omega, t, 1e-9 * t) << kappa;
  }
}

TEST(Sensitivity, AgreesWithADenseScan) {
  RandomLoops random(31);
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) expect_as_scanned(random.next_stable());
}

TEST(Sensitivity, RefusesANeutralLoopThatCannotBeStable) {
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.01, .delta = 1}};
  EXPECT_THROW(Ms(loop), BrokenPromise);
  EXPECT_THROW(Mt(loop), BrokenPromise);
}

}  // namespace
}  // namespace portrait
