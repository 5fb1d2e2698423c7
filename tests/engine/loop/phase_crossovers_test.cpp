#include "engine/loop/phase_crossovers.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "tests/engine/loop/peak_scan.h"
#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

using std::numbers::pi;

TEST(PhaseExtremes, AreWhereTheSlopeOfThePhaseIsZero) {
  RandomLoops random(40);
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    const Loop loop = random.next();
    const OpenLoop open = open_loop(loop);
    for (const double omega : phase_extremes(open)) {
      const double before = log_slope_at(open, omega * (1 - 1e-6)).imag();
      const double after = log_slope_at(open, omega * (1 + 1e-6)).imag();
      EXPECT_LT(before * after, 0) << simulate_command(loop) << " at " << omega;
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

/// The phase leads for a while: between neighbouring extremes it rises or falls on every step of a fine scan.
TEST(PhaseExtremes, NoneIsMissing) {
  RandomLoops random(41);
  for (int i = 0; i < 200; ++i) {
    const Loop loop = random.next();
    const OpenLoop open = open_loop(loop);
    const std::vector<double> extremes = phase_extremes(open);
    std::size_t passed = 0;
    bool rises = log_slope_at(open, 1e-7).imag() > 0;
    for (double omega = 1e-7; omega < 1e4; omega *= 1.003) {
      while (passed < extremes.size() && extremes[passed] < omega) ++passed, rises = !rises;
      const bool near = (passed > 0 && omega < extremes[passed - 1] * 1.004) ||
                        (passed < extremes.size() && omega * 1.004 > extremes[passed]);
      if (near) continue;
      ASSERT_EQ(log_slope_at(open, omega).imag() > 0, rises) << simulate_command(loop) << " at " << omega;
    }
  }
}

/// kappa e^{-s}/s: -pi/2 - omega.
TEST(PhaseCrossovers, OfADelayedIntegrator) {
  const OpenLoop open = open_loop({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.5}});
  const std::vector<double> found = phase_crossovers(open, 20);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], pi / 2 + 2 * pi * static_cast<double>(i), 1e-14);
  EXPECT_NEAR(nearest_phase_crossover(open, 2, kInf).value(), pi / 2 + 2 * pi, 1e-14);
  EXPECT_NEAR(nearest_phase_crossover(open, 2, 0).value(), pi / 2, 1e-14);
  EXPECT_NEAR(nearest_phase_crossover(open, pi / 2, 0).value(), pi / 2, 1e-14);
  EXPECT_FALSE(nearest_phase_crossover(open, 1, 0));
  EXPECT_FALSE(nearest_phase_crossover(open, 2, 7));
}

/// A dense scan of the imaginary part's sign, where L points to the left.
TEST(PhaseCrossovers, AgreeWithADenseScan) {
  RandomLoops random(42);
  for (int i = 0; i < 200; ++i) {
    const Loop loop = random.next();
    std::vector<double> scanned;
    auto last = open_loop_as_written(loop, 1e-4);
    double last_scanned = 1e-4;
    while (last_scanned < 30) {
      const double omega = last_scanned = std::min(last_scanned * 1.002, last_scanned + 0.01);
      const auto here = open_loop_as_written(loop, omega);
      if ((here.imag() < 0) != (last.imag() < 0) && here.real() + last.real() < 0) scanned.push_back(omega);
      last = here;
    }
    std::vector<double> found = phase_crossovers(open_loop(loop), last_scanned);
    std::erase_if(found, [](double omega) { return omega < 1e-4; });
    ASSERT_EQ(found.size(), scanned.size()) << simulate_command(loop);
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], scanned[k], 0.011);
  }
}

}  // namespace
}  // namespace portrait
