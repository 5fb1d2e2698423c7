// Stability, peaks and margins in lanes against the exact search of engine/loop, on every instruction set.
#include "engine/kernel/margins.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/isa/dispatch.h"
#include "engine/loop/margins.h"
#include "engine/loop/parameters.h"
#include "engine/loop/sensitivity.h"
#include "tests/oracle/random_loops.h"

namespace portrait {
namespace {

class LaneMargins : public ::testing::TestWithParam<const kernel::Implementation*> {
 protected:
  kernel::LoopMargins margins_of(const Loop& loop) const {
    kernel::LoopMargins found;
    kernel::find_margins(*GetParam(), loop.family, {&loop.setting, 1}, {&found, 1});
    return found;
  }
};

std::string isa_name(const ::testing::TestParamInfo<const kernel::Implementation*>& isa) { return isa.param->name; }

INSTANTIATE_TEST_SUITE_P(EveryIsa, LaneMargins, ::testing::ValuesIn(available_implementations()), isa_name);

/// Stable or not.
Loop random_loop(oracle::Random& random) {
  const auto plant = static_cast<Plant>(random.below(3));
  const int n = random.below(5);
  Loop loop{{plant, n, Prefilter::none}, oracle::random_controller(random, plant, random.log_uniform(0.01, 100))};
  if (n > 0) loop.setting.tau_f = random.log_uniform(1e-4, 1);
  return loop;
}

/// Both infinite, or within 1e-9.
bool agree(double a, double b) { return a == b || std::abs(a - b) <= 1e-9 * std::abs(b); }

bool stable_with_gain(Loop loop, double factor) {
  loop.setting.kappa *= factor;
  loop.setting.delta *= factor;
  return is_stable(open_loop(loop));
}

TEST_P(LaneMargins, AreThoseOfTheExactSearch) {
  oracle::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Loop loop = random_loop(random);
    const OpenLoop open = open_loop(loop);
    const auto found = margins_of(loop);
    ASSERT_EQ(found.stable, is_stable(open)) << simulate_command(loop);
    if (!found.stable) continue;
    const Peak S = sensitivity_peak(open), T = complementary_sensitivity_peak(open);
    EXPECT_NEAR(found.Ms / S.value, 1, 1e-9) << simulate_command(loop);
    EXPECT_NEAR(found.Mt / T.value, 1, 1e-9) << simulate_command(loop);
    const portrait::Margins exact = margins(open);
    EXPECT_TRUE(agree(found.GM, exact.gain)) << found.GM << ' ' << exact.gain << ' ' << simulate_command(loop);
    EXPECT_TRUE(agree(found.GM_low, exact.gain_low)) << found.GM_low << ' ' << simulate_command(loop);
    EXPECT_TRUE(agree(found.PM, exact.phase_deg)) << found.PM << ' ' << simulate_command(loop);
    EXPECT_TRUE(agree(found.DM, exact.delay)) << found.DM << ' ' << simulate_command(loop);
  }
}

TEST_P(LaneMargins, GainMarginsAreWhereStabilityEnds) {
  oracle::Random random(4);
  int low_ones = 0;
  for (int i = 0; i < 1000; ++i) {
    const Loop loop = random_loop(random);
    const auto found = margins_of(loop);
    if (!found.stable) continue;
    if (found.GM < 1e6) {
      EXPECT_TRUE(stable_with_gain(loop, found.GM * (1 - 1e-8))) << simulate_command(loop);
      EXPECT_FALSE(stable_with_gain(loop, found.GM * (1 + 1e-8))) << simulate_command(loop);
    }
    if (found.GM_low < 1e-9) continue;
    ++low_ones;
    EXPECT_TRUE(stable_with_gain(loop, found.GM_low * (1 + 1e-8))) << simulate_command(loop);
    EXPECT_FALSE(stable_with_gain(loop, found.GM_low * (1 - 1e-8))) << simulate_command(loop);
  }
  EXPECT_GT(low_ones, 100);
}

/// P control of an integrator: everything in closed form.
TEST_P(LaneMargins, ProportionalControlOfAnIntegrator) {
  for (const double kappa : {0.1, 0.5, 1.0, 1.5}) {
    const auto found = margins_of({{Plant::ipdt, 0, Prefilter::none}, {.kappa = kappa}});
    EXPECT_NEAR(found.GM, M_PI_2 / kappa, 1e-12);
    EXPECT_EQ(found.GM_low, 0);
    EXPECT_NEAR(found.PM, 90 - kappa * 180 / M_PI, 1e-11);
    EXPECT_NEAR(found.DM, (M_PI_2 - kappa) / kappa, 1e-12);
  }
}

/// Settings at kappa (1 -+ 1e-6) of the stability limit, which is found by the exact count.
TEST_P(LaneMargins, TheStabilityLimitIsExact) {
  oracle::Random random(6);
  for (int i = 0; i < 300; ++i) {
    Loop loop = random_loop(random);
    double low = 0, high = 1;
    if (!stable_with_gain(loop, 1)) continue;
    while (stable_with_gain(loop, high)) low = high, high *= 2;
    while (high - low > 1e-9 * high) (stable_with_gain(loop, 0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    for (const double factor : {low * (1 - 1e-6), high * (1 + 1e-6)}) {
      Loop near = loop;
      near.setting.kappa *= factor, near.setting.delta *= factor;
      EXPECT_EQ(margins_of(near).stable, factor < low) << simulate_command(near);
    }
  }
}

/// A setting's bits do not depend on what stands beside it.
TEST_P(LaneMargins, NeighboursDoNotMatter) {
  oracle::Random random(9);
  for (const LoopFamily family : {LoopFamily{Plant::dipdt, 1, Prefilter::full}, {Plant::fotd, 0, Prefilter::pi}}) {
    std::vector<Setting> settings;
    for (int i = 0; i < 50; ++i) {
      settings.push_back(oracle::random_controller(random, family.plant, random.log_uniform(0.1, 10)));
      settings.back().tau_f = 0.1;
    }
    std::vector<kernel::LoopMargins> together(settings.size());
    kernel::find_margins(*GetParam(), family, settings, together);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const auto alone = margins_of({family, settings[i]});
      ASSERT_EQ(alone.stable, together[i].stable);
      if (!alone.stable) continue;
      EXPECT_EQ(alone.Ms, together[i].Ms);
      EXPECT_EQ(alone.Mt, together[i].Mt);
      EXPECT_EQ(alone.GM, together[i].GM);
      EXPECT_EQ(alone.DM, together[i].DM);
    }
  }
}

}  // namespace
}  // namespace portrait
