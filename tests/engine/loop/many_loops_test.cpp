/// The comparisons of stability_test.cpp and sensitivity_test.cpp with judges of their own, on many more loops.
#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "tests/engine/loop/peak_scan.h"
#include "tests/engine/loop/random_loops.h"
#include "tests/engine/loop/root_count.h"

namespace portrait {
namespace {

TEST(ManyLoops, UnstableRootsAreThoseOfTheContour) {
  RandomLoops random(100);
  for (int i = 0; i < 10'000; ++i) {
    const Loop loop = random.next();
    if (high_frequency_gain(open_loop(loop)) > 0.99) continue;
    ASSERT_EQ(unstable_roots(open_loop(loop)), unstable_roots_by_contour(loop)) << simulate_command(loop);
  }
}

TEST(ManyLoops, PeaksAreThoseOfTheScan) {
  RandomLoops random(101);
  for (int i = 0; i < 5'000; ++i) {
    const Loop loop = random.next_stable();
    const OpenLoop open = open_loop(loop);
    const Peaks expected = peaks_by_scan(loop);
    ASSERT_NEAR(sensitivity_peak(open).value, expected.Ms, 1e-9 * expected.Ms) << simulate_command(loop);
    ASSERT_NEAR(complementary_sensitivity_peak(open).value, expected.Mt, 1e-9 * expected.Mt)
        << simulate_command(loop);
  }
}

}  // namespace
}  // namespace portrait
