#include "engine/loop/margins.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/loop/parameters.h"
#include "engine/loop/real_plant.h"
#include "engine/loop/stability.h"
#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

using std::numbers::pi;

Margins margins_of(const Loop& loop) { return margins(open_loop(loop)); }

/// L = kappa e^{-s}/s
TEST(Margins, OfADelayedIntegratorUnderP) {
  for (const double kappa : {0.01, 0.3, 1.0, 1.5}) {
    const Margins m = margins_of({{Plant::ipdt, 0, Prefilter::none}, {.kappa = kappa}});
    EXPECT_NEAR(m.gain, pi / (2 * kappa), 1e-13 * m.gain);
    EXPECT_EQ(m.gain_low, 0);
    EXPECT_NEAR(m.phase_deg, 90 - kappa * 180 / pi, 1e-12);
    EXPECT_NEAR(m.delay, pi / (2 * kappa) - 1, 1e-13 * m.gain);
  }
}

/// L = (kappa + delta s) e^{-s}/s^2: |L| = 1 where omega^4 = kappa^2 + delta^2 omega^2, arg L = -pi where
/// tan(omega) = delta omega/kappa.
TEST(Margins, OfADoubleIntegratorUnderPD) {
  const double kappa = 0.1, delta = 0.5;
  const Margins m = margins_of({{Plant::dipdt, 0, Prefilter::none}, {.kappa = kappa, .delta = delta}});
  const double gain = std::sqrt((delta * delta + std::sqrt(std::pow(delta, 4) + 4 * kappa * kappa)) / 2);
  const double lag = std::atan(delta * gain / kappa) - gain;
  double phase = 1;
  for (int i = 0; i < 100; ++i) phase = std::atan(delta * phase / kappa);
  EXPECT_NEAR(m.gain, phase * phase / std::hypot(kappa, delta * phase), 1e-12);
  EXPECT_EQ(m.gain_low, 0);
  EXPECT_NEAR(m.phase_deg, lag * 180 / pi, 1e-11);
  EXPECT_NEAR(m.delay, lag / gain, 1e-12);
}

/// L = kappa e^{-s}/(tau_1 s + 1) below 1 everywhere: nothing but gain endangers it.
TEST(Margins, OfALoopWithoutGainCrossover) {
  const double kappa = 0.8, tau_1 = 2;
  const Margins m = margins_of({{Plant::fotd, 0, Prefilter::none}, {.kappa = kappa, .tau_1 = tau_1}});
  double omega = 2;
  for (int i = 0; i < 100; ++i) omega = pi - std::atan(tau_1 * omega);
  EXPECT_NEAR(m.gain, std::hypot(1, tau_1 * omega) / kappa, 1e-12);
  EXPECT_EQ(m.gain_low, 0);
  EXPECT_EQ(m.phase_deg, kInf);
  EXPECT_EQ(m.delay, kInf);
}

/// Three integrators: too little gain is as bad as too much.
TEST(Margins, GainLowOfADoubleIntegratorUnderPID) {
  const Margins m = margins_of({{Plant::dipdt, 0, Prefilter::none}, {.kappa = 0.1, .tau_i = 12, .delta = 0.5}});
  EXPECT_GT(m.gain_low, 0.05);
  EXPECT_LT(m.gain_low, 1);
}

/// |L| grows towards its limit: no frequency attains the margin.
TEST(Margins, ANeutralLoopsGainMarginMayBeItsLimit) {
  const Margins m = margins_of({{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.02, .delta = 1.4, .tau_1 = 2}});
  EXPECT_NEAR(m.gain, 1 / 0.7, 1e-14);
}

Loop scaled(Loop loop, double factor) {
  loop.setting.kappa *= factor;
  loop.setting.delta *= factor;
  return loop;
}

/// The same controller and the same plant but for its dead time.
Loop with_dead_time(const Loop& loop, double Td) {
  RealPlant plant{loop.family.plant, 1, 1, loop.setting.tau_1};
  const RealController controller = controller_for(loop, plant);
  plant.Td = Td;
  return {loop.family, normalised(controller, plant, loop.family)};
}

bool stable(const Loop& loop) { return is_stable(open_loop(loop)); }

constexpr double kStep = 1e-6;

template <typename Check>
void for_random_stable_loops(std::uint64_t seed, Check check) {
  RandomLoops random(seed);
  for (int i = 0; i < 3000 && !testing::Test::HasFailure(); ++i) {
    const Loop loop = random.next_stable();
    SCOPED_TRACE(simulate_command(loop));
    check(loop, margins_of(loop));
  }
}

TEST(Margins, StabilityIsLostAtTheGainMargin) {
  for_random_stable_loops(50, [](const Loop& loop, const Margins& m) {
    ASSERT_TRUE(std::isfinite(m.gain));
    if (m.gain < 1 + 2 * kStep) return;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(stable(scaled(loop, 1 + (m.gain - 1) * i / 10)));
    EXPECT_TRUE(stable(scaled(loop, m.gain * (1 - kStep))));
    EXPECT_FALSE(stable(scaled(loop, m.gain * (1 + kStep))));
  });
}

TEST(Margins, StabilityIsLostAtTheLowGainMargin) {
  int conditional = 0;
  for_random_stable_loops(51, [&](const Loop& loop, const Margins& m) {
    if (m.gain_low > 1 - 2 * kStep) return;
    conditional += m.gain_low > 0;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(stable(scaled(loop, 1 + (m.gain_low - 1) * i / 10)));
    if (m.gain_low == 0) return;
    EXPECT_TRUE(stable(scaled(loop, m.gain_low * (1 + kStep))));
    EXPECT_FALSE(stable(scaled(loop, m.gain_low * (1 - kStep))));
  });
  EXPECT_GT(conditional, 100);
}

TEST(Margins, StabilityIsLostAtTheDelayMargin) {
  for_random_stable_loops(52, [](const Loop& loop, const Margins& m) {
    const double most = std::isinf(m.delay) ? 1000 : m.delay;
    if (most < 2 * kStep) return;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(stable(with_dead_time(loop, 1 + most * i / 10)));
    EXPECT_TRUE(stable(with_dead_time(loop, 1 + most * (1 - kStep))));
    if (std::isfinite(m.delay)) {
      EXPECT_FALSE(stable(with_dead_time(loop, 1 + m.delay * (1 + kStep))));
    }
  });
}

/// The phase margin in radians over the highest gain crossover is a delay the loop bears.
TEST(Margins, ThePhaseMarginIsASafeDelay) {
  for_random_stable_loops(53, [](const Loop& loop, const Margins& m) {
    const std::vector<double> crossovers = gain_crossovers(open_loop(loop));
    EXPECT_EQ(std::isinf(m.phase_deg), crossovers.empty());
    if (crossovers.empty()) return;
    EXPECT_GT(m.phase_deg, 0);
    EXPECT_LE(m.phase_deg, 180);
    EXPECT_LE(m.phase_deg * pi / 180 / crossovers.back(), m.delay * (1 + 1e-12));
  });
}

TEST(Margins, RefuseANeutralLoopThatCannotBeStable) {
  EXPECT_THROW(margins_of({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.01, .delta = 1}}), BrokenPromise);
}

}  // namespace
}  // namespace portrait
