#include "bench/cases.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "bench/codes.h"
#include "engine/loop/parameters.h"
#include "engine/loop/stability.h"

namespace portrait::bench {
namespace {

TEST(Cases, AreStableAndWithinWhatTheStepLoopTakes) {
  for (const Case& of : cases()) {
    SCOPED_TRACE(of.name);
    EXPECT_EQ(of.settings.size(), 3200u);
    EXPECT_EQ(of.grid.family.n, 1);
    EXPECT_EQ(of.grid.family.prefilter, Prefilter::full);
    EXPECT_EQ(of.grid.horizon.dead_times, 51);
    const bool derivative = of.settings.front().delta > 0;
    for (const Setting& s : of.settings) {
      ASSERT_TRUE(is_stable(open_loop({of.grid.family, s}))) << setting_text({of.grid.family, s});
      ASSERT_EQ(s.delta > 0, derivative);
      ASSERT_TRUE(has_integral_action(s) && s.b == 0 && s.c == 0);
    }
  }
}

TEST(Cases, FewOfEachComeFromAllOverTheBox) {
  for (const Case& few : few_of_each(cases())) {
    SCOPED_TRACE(few.name);
    EXPECT_EQ(few.settings.size(), 33u);
    for (const Axis& axis : few.grid.axes) {
      std::vector<double> seen;
      for (const Setting& s : few.settings) seen.push_back(get(s, axis.parameter()));
      std::sort(seen.begin(), seen.end());
      EXPECT_GT(seen.back() - seen.front(), 0.8 * (axis[axis.size() - 1] - axis[0])) << axis.name();
    }
  }
}

TEST(Cases, TheSweepIsAboutAsLongAsAsked) {
  EXPECT_EQ(setting_count(sweep_grid(1)), 128u);
  EXPECT_NEAR(static_cast<double>(setting_count(sweep_grid(1'000'000))), 1e6, 2e4);
}

TEST(Cases, TimedAreAllMeasuresButNoise) {
  const std::vector<Measure> timed = timed_measures();
  const auto has = [&](Measure m) { return std::find(timed.begin(), timed.end(), m) != timed.end(); };
  for (const Measure m : all_measures())
    EXPECT_EQ(has(m), is_standard(m) && m != Measure::noise_gain) << to_string(m);
}

}  // namespace
}  // namespace portrait::bench
