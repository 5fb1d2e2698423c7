/// The promise of engine/reference/response.h: IAE to 1e-9, TV to 1e-7, whatever the resolution, over all families,
/// tau_f 1e-4 .. 1 and tau_1 0.01 .. 100. The most that was seen over 8000 such loops is 5e-11 and 4e-8, the latter
/// with 18 stages; against exact responses (exact_measures_slow_test.cpp) 14 stages are ten times better.

#include <string>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "tests/engine/reference/same_measures.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

TEST(Resolution, MeasuresDoNotDependOnIt) {
  oracle::Random random(41);
  for (int trial = 0; trial < 120; ++trial) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const Measured found = measure(loop, Horizon::fixed(30));
    const Measured finer = measure(loop, Horizon::fixed(30), {.stages = 18, .least_panels = 2});
    expect_same_measures(found.measures, finer.measures);
    EXPECT_EQ(found.status, finer.status);
  }
}

/// Every layer of the smallest time constants there are, one at a time.
TEST(Resolution, AtTheEndsOfTheRanges) {
  for (const double tau_f : {1e-4, 1.0})
    for (const double tau_1 : {1e-4, 0.01, 100.0})
      for (const int n : {1, 4}) {
        const Loop loop{
            {Plant::fotd, n, Prefilter::full},
            {.kappa = 0.3, .tau_i = 0.8 * (1 + tau_1), .delta = 0.1 * tau_1, .tau_1 = tau_1, .tau_f = tau_f}};
        SCOPED_TRACE(simulate_command(loop));
        expect_same_measures(measure(loop, Horizon::fixed(30)).measures,
                             measure(loop, Horizon::fixed(30), {.stages = 18, .least_panels = 2}).measures);
      }
}

TEST(Resolution, OfFewStagesIsMadeUpByMorePanels) {
  const Loop loop{{Plant::dipdt, 1, Prefilter::full},
                  {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1}};
  const Response coarse = simulate(loop, Horizon::fixed(20), {.stages = 6});
  EXPECT_GT(coarse.steps[0].pieces.size(), simulate(loop, Horizon::fixed(20)).steps[0].pieces.size());
  expect_same_measures(measure(loop, coarse).measures, measure(loop, Horizon::fixed(20)).measures);
}

TEST(Resolution, ThatCannotBeReachedIsAnErrorThatNamesTheLoop) {
  const Loop loop{{Plant::ipdt, 1, Prefilter::full}, {.kappa = 0.5, .tau_i = 6, .delta = 0.1, .tau_f = 0.1}};
  try {
    simulate(loop, Horizon::fixed(5), {.stages = 2, .tolerance = 1e-13});
    FAIL() << "two stages cannot";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "the reference simulation cannot resolve this loop with 400 panels a dead time: " + simulate_command(loop));
  }
}

}  // namespace
}  // namespace portrait::reference
