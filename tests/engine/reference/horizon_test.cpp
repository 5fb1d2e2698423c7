/// How long the reference simulation runs, and what it says when it stops.

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/loop/parameters.h"
#include "engine/loop/stability.h"
#include "engine/reference/measure.h"
#include "tests/oracle/quadrature.h"

namespace portrait::reference {
namespace {

const Loop kLoop{{Plant::dipdt, 1, Prefilter::full},
                 {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1}};

void expect_without_gaps(const std::vector<Piece>& pieces, double horizon) {
  ASSERT_FALSE(pieces.empty());
  double end = 0;
  for (const Piece& piece : pieces) {
    EXPECT_NEAR(piece.start, end, 1e-13);
    EXPECT_GT(piece.length, 0);
    end = piece.start + piece.length;
  }
  EXPECT_NEAR(end, horizon, 1e-13);
}

TEST(Horizon, PiecesReachFromZeroToItWithoutGaps) {
  for (const double horizon : {0.25, 1.0, 7.0, 7.5, 7.999, 50.3}) {
    const Response r = simulate(kLoop, Horizon::fixed(horizon));
    EXPECT_EQ(r.horizon, horizon);
    for (const StepResponse& step : std::span(r.steps).first(2)) expect_without_gaps(step.pieces, horizon);
  }
}

TEST(Horizon, CutPiecesAreTheSameResponse) {
  const Response whole = simulate(kLoop, Horizon::fixed(8)), cut = simulate(kLoop, Horizon::fixed(7.37));
  for (const Step step : kUsualSteps)
    for (double t = 0; t <= 7.37; t += 0.0331) {
      EXPECT_NEAR(y_at(cut.steps[step], t), y_at(whole.steps[step], t), 1e-13);
      EXPECT_NEAR(u_at(cut.steps[step], t), u_at(whole.steps[step], t), 1e-12);
    }
}

TEST(Horizon, BetweenTwoDeadTimesMeasuresLieBetween) {
  const MeasureRow a = measure(kLoop, Horizon::fixed(20)).measures,
                   b = measure(kLoop, Horizon::fixed(20.3)).measures,
                   c = measure(kLoop, Horizon::fixed(21)).measures;
  using enum Measure;
  for (const Measure m : {IAE_w, IAE_d, TV_yw, TV_uw, TV_yd, TV_ud}) {
    EXPECT_GT(b[m], a[m]) << to_string(m);
    EXPECT_LT(b[m], c[m]) << to_string(m);
  }
}

TEST(Horizon, IntegralsOfErrorAddUp) {
  const Response r = simulate(kLoop, Horizon::fixed(21));
  const double rest = oracle::integral(oracle::gauss_rule(30), 20, 20.3,
                                       [&](double t) { return std::abs(y_at(r.steps[kDisturbance], t)); });
  const double until_20 = measure(kLoop, Horizon::fixed(20)).measures[Measure::IAE_d];
  EXPECT_NEAR(measure(kLoop, Horizon::fixed(20.3)).measures[Measure::IAE_d], until_20 + rest, 1e-10);
}

TEST(Horizon, OfNothingIsOurMistake) {
  EXPECT_THROW(simulate(kLoop, Horizon::fixed(0)), BrokenPromise);
  EXPECT_THROW(simulate({{Plant::dipdt, 1, Prefilter::full}, {}}, Horizon::fixed(1)), BrokenPromise);
}

/// A long fixed horizon changes nothing any more; random loops: random_loops_slow_test.cpp.
TEST(AutomaticHorizon, IsLongEnough) {
  const Loop loops[] = {
      kLoop,
      {{Plant::dipdt, 0, Prefilter::pi}, {.kappa = 0.24, .tau_i = 8, .delta = 0.7}},
      {{Plant::ipdt, 0, Prefilter::pi}, {.kappa = 0.5, .tau_i = 60, .delta = 0.3}},
      {{Plant::fotd, 3, Prefilter::full}, {.kappa = 20, .tau_i = 30, .delta = 9, .tau_1 = 50, .tau_f = 0.01}}};
  using enum Measure;
  for (const Loop& loop : loops) {
    SCOPED_TRACE(simulate_command(loop));
    const Measured found = measure(loop, Horizon::until_settled());
    EXPECT_EQ(found.status, Status::settled);
    const MeasureRow longer = measure(loop, Horizon::fixed(3 * found.horizon)).measures;
    for (const Measure m : {IAE_w, IAE_d})
      EXPECT_NEAR(found.measures[m], longer[m], 1e-9 * longer[m]) << to_string(m);
    for (const Measure m : {TV_yw, TV_uw, TV_yd, TV_ud})
      EXPECT_NEAR(found.measures[m], longer[m], 1e-7 * longer[m]) << to_string(m);
  }
}

/// Stable, and decaying by less than 1e-5 in a dead time.
TEST(AutomaticHorizon, GivesUpAtTheCap) {
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 1.5707}};
  ASSERT_TRUE(is_stable(open_loop(loop)));
  const Response r = simulate(loop, Horizon::until_settled());
  EXPECT_EQ(r.horizon, kHorizonCap);
  EXPECT_FALSE(r.quiet);
  EXPECT_EQ(measure(loop, r).status, Status::not_settled);
}

TEST(AutomaticHorizon, OfANeutralLoopWhoseJumpsDecay) {
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.1, .delta = 0.8}};
  const Response r = simulate(loop, Horizon::until_settled());
  EXPECT_TRUE(r.quiet);
  EXPECT_EQ(measure(loop, r).status, Status::settled);
}

TEST(UnstableLoop, EndsAtTheGrowthLimitWithoutAnError) {
  const Loop runaway[] = {{{Plant::dipdt, 0, Prefilter::none}, {.kappa = 2}},
                          {{Plant::ipdt, 0, Prefilter::none}, {.kappa = 1, .delta = 2}},
                          {{Plant::ipdt, 3, Prefilter::full}, {.kappa = 3, .tau_i = 1, .delta = 5, .tau_f = 1e-3}},
                          {{Plant::fotd, 1, Prefilter::pi}, {.kappa = 50, .tau_i = 1, .tau_1 = 0.5, .tau_f = 0.1}}};
  for (const Loop& loop : runaway) {
    SCOPED_TRACE(simulate_command(loop));
    const Response r = simulate(loop, Horizon::fixed(1000));
    EXPECT_LT(r.horizon, 1000);
    EXPECT_FALSE(r.quiet);
    expect_without_gaps(r.steps[kSetpoint].pieces, r.horizon);
    EXPECT_LT(std::abs(y_at(r.steps[kDisturbance], r.horizon)), 1e30);
  }
}

TEST(UnstableLoop, HasNoMeasures) {
  const Loop loop{{Plant::dipdt, 0, Prefilter::none}, {.kappa = 2}};
  for (const Horizon horizon : {Horizon::fixed(50), Horizon::until_settled()}) {
    const Measured measured = measure(loop, horizon);
    EXPECT_EQ(measured.status, Status::unstable);
    EXPECT_EQ(measured.horizon, 0);
    for (const Measure m : all_measures()) EXPECT_TRUE(std::isnan(measured.measures[m])) << to_string(m);
  }
}

}  // namespace
}  // namespace portrait::reference
