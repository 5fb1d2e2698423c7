/// The promises of the reference simulation over more random loops than the fast tests have time for.

#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "tests/engine/reference/same_measures.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

/// A long fixed horizon changes nothing any more.
TEST(RandomLoopsSlow, AutomaticHorizonsAreLongEnough) {
  oracle::Random random(61);
  using enum Measure;
  int quiet = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const Measured found = measure(loop, Horizon::until_settled());
    if (found.horizon > 1000) continue;  // slow loops: the same, but seconds
    ++quiet;
    EXPECT_EQ(found.status, Status::settled);
    const MeasureRow longer = measure(loop, Horizon::fixed(2 * found.horizon)).measures;
    for (const Measure m : {IAE_w, IAE_d}) {
      if (std::isnan(longer[m])) continue;
      EXPECT_NEAR(found.measures[m], longer[m], 1e-9 * longer[m]) << to_string(m);
    }
    for (const Measure m : {TV_yw, TV_uw, TV_yd, TV_ud})
      EXPECT_NEAR(found.measures[m], longer[m], 1e-7 * longer[m]) << to_string(m);
  }
  EXPECT_GT(quiet, 40);
}

TEST(RandomLoopsSlow, MeasuresDoNotDependOnTheResolution) {
  oracle::Random random(62);
  for (int trial = 0; trial < 1500; ++trial) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const Measured finer = measure(loop, Horizon::fixed(30), {.stages = 18, .least_panels = 2});
    expect_same_measures(measure(loop, Horizon::fixed(30)).measures, finer.measures);
  }
}

}  // namespace
}  // namespace portrait::reference
