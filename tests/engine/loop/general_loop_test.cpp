#include "engine/loop/general_loop.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/margins.h"
#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "tests/engine/loop/root_count.h"
#include "tests/oracle/random_general.h"

namespace portrait {
namespace {

using Complex = std::complex<double>;
using oracle::Random;

/// Plants with unstable poles and either sign of the gain too.
GeneralLoop any_loop(Random& random, double dead_time) {
  GeneralLoop loop = oracle::random_general_loop(random, dead_time);
  if (random.chance(0.3)) {
    loop.plant.rational.denominator.push_back({1, -random.log_uniform(0.5, 5)});
    for (Polynomial* p : {&loop.controller.on_output, &loop.controller.on_setpoint})
      *p = scaled(random.log_uniform(1, 10), *p);
  }
  if (random.chance(0.2)) loop.plant.rational.numerator = scaled(-1, loop.plant.rational.numerator);
  return loop;
}

TEST(GeneralStability, CountsAsTheContourDoes) {
  Random random(410);
  int unstable = 0, stable = 0;
  for (int i = 0; i < 400; ++i) {
    const GeneralLoop loop = any_loop(random, random.chance(0.5) ? 1 : 0);
    if (why_invalid(loop)) continue;
    SCOPED_TRACE(i);
    const int found = unstable_roots(open_loop(loop));
    ASSERT_EQ(found, unstable_roots_by_contour(loop));
    (found == 0 ? stable : unstable) += 1;
  }
  EXPECT_GT(stable, 50);
  EXPECT_GT(unstable, 50);
}

/// Stability is lost just at GM, GM_low and DM.
TEST(GeneralMargins, AreWhereStabilityIsLost) {
  Random random(411);
  const auto stable_with = [](GeneralLoop loop, double gain, double delay) {
    loop.controller.on_output = scaled(gain, loop.controller.on_output);
    loop.plant.dead_time += delay;
    return is_stable(open_loop(loop));
  };
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const GeneralLoop loop = any_loop(random, random.chance(0.5) ? 1 : 0);
    if (why_invalid(loop) || !is_stable(open_loop(loop))) continue;
    SCOPED_TRACE(i);
    const Margins m = margins(open_loop(loop));
    if (std::isfinite(m.gain)) {
      EXPECT_TRUE(stable_with(loop, m.gain * (1 - 1e-7), 0));
      EXPECT_FALSE(stable_with(loop, m.gain * (1 + 1e-7), 0));
      ++checked;
    } else {
      EXPECT_TRUE(stable_with(loop, 1e4, 0));
    }
    if (m.gain_low > 0) {
      EXPECT_TRUE(stable_with(loop, m.gain_low * (1 + 1e-7), 0));
      EXPECT_FALSE(stable_with(loop, m.gain_low * (1 - 1e-7), 0));
    }
    if (std::isfinite(m.delay)) {
      EXPECT_TRUE(stable_with(loop, 1, m.delay * (1 - 1e-7)));
      EXPECT_FALSE(stable_with(loop, 1, m.delay * (1 + 1e-7)));
    }
  }
  EXPECT_GT(checked, 60);
}

/// The phase of k/(s (s + 1)) tends to -180 degrees and never comes there.
TEST(GeneralMargins, OfAPhaseThatOnlyTendsToTheCriticalOne) {
  const GeneralLoop loop{{{{1}, {{0, 1}, {1, 1}}}, 0}, pid_controller({.Kp = 5, .Ki = 0, .Kd = 0})};
  const Margins m = margins(open_loop(loop));
  EXPECT_EQ(m.gain, kInf);
  EXPECT_EQ(m.gain_low, 0);
  EXPECT_GT(m.phase_deg, 20);
  EXPECT_TRUE(std::isfinite(m.delay));
}

/// A scan can only find less.
TEST(GeneralSensitivity, IsThePeakOfAScan) {
  Random random(412);
  for (int i = 0; i < 150; ++i) {
    const GeneralLoop loop = any_loop(random, random.chance(0.5) ? 1 : 0);
    if (why_invalid(loop) || !is_stable(open_loop(loop))) continue;
    SCOPED_TRACE(i);
    double Ms = 1;
    for (double omega = 1e-4; omega < 1e4; omega *= 1.002) {
      const Complex s(0, omega), L = value(loop.plant.rational, s) * std::exp(-s * loop.plant.dead_time) *
                                     value({loop.controller.on_output, loop.controller.denominator}, s);
      Ms = std::max(Ms, 1 / std::abs(1.0 + L));
    }
    const double found = sensitivity_peak(open_loop(loop)).value;
    EXPECT_GE(found, Ms * (1 - 1e-9));
    EXPECT_LE(found, Ms * (1 + 1e-2));
  }
}

TEST(GeneralLoop, NormalisedHasDeadTimeAndGainOne) {
  Random random(413);
  for (int i = 0; i < 50; ++i) {
    GeneralLoop loop = oracle::random_general_loop(random, 1);
    loop.plant.dead_time = random.log_uniform(0.2, 5);
    const NormalisedLoop inside = normalised(loop);
    EXPECT_EQ(inside.loop.plant.dead_time, 1);
    EXPECT_EQ(inside.units.time, loop.plant.dead_time);
    const double omega = random.log_uniform(0.01, 10);
    const Complex real = response_at(open_loop(loop), omega / inside.units.time);
    EXPECT_LE(std::abs(response_at(open_loop(inside.loop), omega) - real), 1e-11 * std::abs(real));
    Factored P = factored({inside.loop.plant.rational.numerator});
    EXPECT_NEAR(P.lowest / factored(inside.loop.plant.rational.denominator).lowest, 1, 1e-14);
  }
}

struct WrongCase {
  GeneralLoop loop;
  std::string reason;
};

TEST(GeneralLoop, SaysWhyItCannotBe) {
  const GeneralController pi = pid_controller({.Kp = 1, .Ki = 1, .Kd = 0});
  const GeneralPlant lag{multiple_lag(1, 1, 1), 1};
  const auto with = [&](TransferFunction P, double Td, GeneralController c) {
    return GeneralLoop{{std::move(P), Td}, std::move(c)};
  };
  GeneralController bad_prefilter = pi, unstable_prefilter = pi;
  bad_prefilter.prefilter = {{1, 1}, {}};
  unstable_prefilter.prefilter = {{1}, {{1, -1}}};
  const WrongCase cases[] = {
      {with({{1, 1, 1}, {{1, 1}}}, 1, pi), "the plant is improper: its numerator has degree 2, its denominator 1"},
      {with({{}, {{1, 1}}}, 1, pi), "the plant is 0"},
      {with({{1}, {{1, 1}}}, -1, pi), "the dead time must be finite and not below 0 (it is -1)"},
      {with({{1}, {{1, 1}}}, 1, controller({{1, 1, 1, 1}, {{1, 1}}})),
       "the controller is improper: degree 3 over 1; a filter of higher order makes it proper"},
      {with({{2, 1}, {{1, 1}}}, 0, pi),
       "an algebraic loop: without dead time plant and controller both answer at once; give one of them a lag, or "
       "the plant "
       "a dead time"},
      {with({{1}, {{1, -1}}}, 1, controller({{1, -1}, {{1, 1}}})),
       "a zero of the controller cancels an unstable pole of the plant at s = 1: the loop is unstable inside"},
      {with({{1, -2}, {{1, 1}, {1, 1}}}, 1, controller({{1}, {{1, -2}}})),
       "a zero of the plant cancels an unstable pole of the controller at s = 0.5: the loop is unstable inside"},
      {with({{0, 1}, {{1, 1}, {1, 1}}}, 1, pi),
       "a zero of the plant at s = 0 cancels an integrator of the controller: what it holds never settles"},
      {with(lag.rational, 1, bad_prefilter), "the prefilter is improper: a step through it is an impulse"},
      {with(lag.rational, 1, unstable_prefilter), "the prefilter has a pole at s = 1: it is not stable"},
      {with({{1, 1}, {{1, 2}}}, 1, pid_controller({.Kp = 1, .Ki = 0, .Kd = 1})),
       "the ideal derivative of an output that follows the input at once is an impulse; give the controller a "
       "filter"},
  };
  for (const WrongCase& c : cases) EXPECT_EQ(why_invalid(c.loop).value_or("valid"), c.reason);
}

TEST(GeneralLoop, WeightsAreThoseOfTheSetpoint) {
  const GeneralController c = with_weights(pid_controller({.Kp = 2, .Ki = 3, .Kd = 4}, 1, 0.1), 0.5, 0.25);
  EXPECT_EQ(c.on_setpoint, (Polynomial{3, 1, 1}));
  EXPECT_EQ(c.on_output, (Polynomial{3, 2, 4}));
  const GeneralController pd = with_weights(pid_controller({.Kp = 2, .Ki = 0, .Kd = 4}, 1, 0.1), 0.5, 0);
  EXPECT_EQ(pd.on_setpoint, (Polynomial{1}));
}

/// Numbers whose products no double holds are refused: roots would be lost without a word.
TEST(GeneralLoopReason, TimesThatLieTooFarApart) {
  const GeneralLoop usual{{multiple_lag(1, 2, 3), 1}, pid_controller(parallel(StandardForm{0.5, 4, 0.5}), 1, 0.1)};
  EXPECT_EQ(why_invalid(usual), std::nullopt);
  GeneralLoop loop = usual;
  loop.plant.dead_time = 3e44;
  EXPECT_EQ(why_invalid(loop), "its times lie too far apart to compute with: 0.1 to 3e+44");
  loop.plant.dead_time = 1e-9;
  EXPECT_EQ(why_invalid(loop), std::nullopt);
  loop = usual, loop.plant.rational.numerator = {1e70};
  EXPECT_EQ(why_invalid(loop), "a coefficient is beyond what can be computed with: 1e-60 to 1e60, or 0");
}

}  // namespace
}  // namespace portrait
