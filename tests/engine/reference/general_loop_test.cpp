/// General loops against Laplace inversion, and what must not depend on how a loop is written down.

#include "engine/loop/general_loop.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/loop/stability.h"
#include "engine/reference/measure.h"
#include "tests/engine/reference/same_measures.h"
#include "tests/oracle/laplace.h"
#include "tests/oracle/random_general.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

using oracle::Random;
using Real = oracle::Real;
using Complex = oracle::Complex;

Complex value(const Polynomial& p, Complex s) {
  Complex sum = 0;
  for (auto a = p.rbegin(); a != p.rend(); ++a) sum = sum * s + Real{*a};
  return sum;
}

Complex over(const Polynomial& N, const std::vector<Polynomial>& D, Complex s) {
  Complex found = value(N, s);
  for (const Polynomial& factor : D) found /= value(factor, s);
  return found;
}

/// The loop's parts at s, without dead time.
struct Parts {
  Parts(const GeneralLoop& loop, Complex s)
      : P(over(loop.plant.rational.numerator, loop.plant.rational.denominator, s)),
        Cy(over(loop.controller.on_output, loop.controller.denominator, s)),
        CrF(over(loop.controller.on_setpoint, loop.controller.denominator, s) *
            over(loop.controller.prefilter.numerator, loop.controller.prefilter.denominator, s)) {}

  /// y or u after a step is (direct + looped e^{-Td s}) / (1 + L); L less its dead time is P Cy.
  Complex direct(Step step, bool of_y) const {
    if (of_y) return step == kOutputStep ? 1 : 0;
    return step == kSetpoint ? CrF : step == kOutputStep ? -Cy : 0;
  }
  Complex looped(Step step, bool of_y) const {
    if (of_y) return step == kSetpoint ? P * CrF : step == kDisturbance ? P : 0;
    return step == kDisturbance ? -Cy * P : 0;
  }

  Complex P, Cy, CrF;
};

oracle::Inverted by_laplace(const GeneralLoop& loop, Step step, bool of_y, double t) {
  if (loop.plant.dead_time == 0) {
    const auto F = [&](Complex s) {
      const Parts at(loop, s);
      return (at.direct(step, of_y) + at.looped(step, of_y)) / (Real{1} + at.P * at.Cy) / s;
    };
    return oracle::inverted(F, t);
  }
  oracle::Inverted sum{0, 0};
  const auto add = [&](const oracle::Inverted& term) { sum.value += term.value, sum.uncertain += term.uncertain; };
  for (int k = 0; k < t; ++k) {
    const auto term = [&](Complex s, bool delayed) {
      const Parts at(loop, s);
      return std::pow(-at.P * at.Cy, k) * (delayed ? at.looped(step, of_y) : at.direct(step, of_y)) / s;
    };
    add(oracle::inverted([&](Complex s) { return term(s, false); }, Real{t} - k));
    if (t > k + 1) add(oracle::inverted([&](Complex s) { return term(s, true); }, Real{t} - k - 1));
  }
  return sum;
}

/// Compares where the transform can be inverted to 1e-9; gives how many instants those were.
int expect_as_laplace(const GeneralLoop& loop, const Response& r) {
  int compared = 0;
  for (const Step step : kAllSteps)
    for (const bool of_y : {true, false}) {
      Real worst = 0, largest = 1;
      for (double t = 0.23; t < 5; t += 0.37) {
        const auto [expected, uncertain] = by_laplace(loop, step, of_y, t);
        largest = std::max(largest, std::abs(expected));
        if (uncertain > 1e-9L * largest) continue;
        const double found = of_y ? y_at(r.steps[step], t) : u_at(r.steps[step], t);
        worst = std::max(worst, std::abs(expected - found));
        ++compared;
      }
      EXPECT_LE(worst, 1e-8L * largest) << "step " << step << (of_y ? " y" : " u");
    }
  return compared;
}

#ifdef PORTRAIT_SANITIZED
constexpr int kLoops = 8;
#else
constexpr int kLoops = 40;
#endif

TEST(GeneralLoop, RespondsAsTheLaplaceTransformSays) {
  Random random(400);
  int compared = 0;
  for (int i = 0; i < kLoops; ++i) {
    SCOPED_TRACE(i);
    const GeneralLoop loop = oracle::random_general_loop(random, 1);
    compared += expect_as_laplace(loop, simulate(loop, Horizon::fixed(5), {}, kAllSteps));
  }
  EXPECT_GT(compared, 70 * kLoops);  // of 78
}

TEST(GeneralLoop, WithoutDeadTimeRespondsAsTheLaplaceTransformSays) {
  Random random(401);
  int compared = 0, stable = 0;
  for (int i = 0; i < 2 * kLoops; ++i) {
    SCOPED_TRACE(i);
    const GeneralLoop loop = oracle::random_general_loop(random, 0);
    if (!is_stable(open_loop(loop))) continue;
    compared += expect_as_laplace(loop, simulate(loop, Horizon::fixed(5), {}, kAllSteps));
    ++stable;
  }
  EXPECT_GT(stable, kLoops / 2);
  EXPECT_GT(compared, 70 * stable);
}

/// A loop with less and less dead time tends to the one without, in proportion.
TEST(GeneralLoop, TendsToTheLoopWithoutDeadTime) {
  Random random(403);
  for (int i = 0; i < 5; ++i) {
    GeneralLoop loop = oracle::random_general_loop(random, 0);
    if (!is_stable(open_loop(loop))) continue;
    SCOPED_TRACE(i);
    const double horizon = 4;
    const MeasureRow limit = measure_in_units(loop, Horizon::fixed(horizon)).measured.measures;
    double before = 0;
    for (const double dead_time : {0.02, 0.01, 0.005}) {
      loop.plant.dead_time = dead_time;
      const double off =
          measure_in_units(loop, Horizon::fixed(horizon)).measured.measures[Measure::ISE_w] - limit[Measure::ISE_w];
      if (before != 0) {
        EXPECT_NEAR(before / off, 2, 0.2) << dead_time;
      }
      before = off;
    }
    loop.plant.dead_time = 0;
  }
}

/// Lifted into the general form, the loops of the normalised families are the same loops.
TEST(GeneralLoop, OfTheNormalisedFamiliesHasTheirMeasures) {
  Random random(402);
  for (int i = 0; i < kLoops; ++i) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const Measured expected = measure(loop, Horizon::fixed(20)), found = measure(general(loop), Horizon::fixed(20));
    EXPECT_EQ(found.status, expected.status);
    expect_same_measures(found.measures, expected.measures);
  }
}

}  // namespace
}  // namespace portrait::reference
