// The promise of engine/kernel/cascade.inl: plants of many lags and controllers given by their gains, against the reference
// simulation of the same loop written out as transfer functions.
#include <gtest/gtest.h>

#include "engine/kernel/measure.h"
#include "engine/loop/loop_measures.h"
#include "tests/engine/kernel/comparison.h"
#include "tests/oracle/random_cascades.h"

namespace portrait {
namespace {

using oracle::random_cascade;

#ifdef PORTRAIT_SANITIZED
constexpr int kLoops = 60;
#else
constexpr int kLoops = 400;
#endif

struct CascadeErrors {
  Worst integral, variation;
  int unresolved = 0, status_differs = 0;
};

CascadeErrors errors_over_cascades(const kernel::Implementation& implementation, int count, std::uint64_t seed) {
  oracle::Random random(seed);
  CascadeErrors errors;
  for (int i = 0; i < count; ++i) {
    const Loop loop = random_cascade(random);
    const Horizon horizon = Horizon::fixed(random.chance(0.3) ? random.uniform(5, 40) : 10 + random.below(50));
    const auto fast = measure_one(implementation, loop, horizon);
    errors.unresolved += fast.resolved ? 0 : 1;
    if (!fast.resolved) continue;  // a sweep asks the reference
    const auto slow = reference::measure(loop, horizon);
    errors.status_differs += fast.status == slow.status ? 0 : 1;
    for (const Measure m : response_measures()) {
      double error = error_of(fast.measures[m], slow.measures[m]);
      const double variation = variation_of_signal(slow.measures, m);
      if (variation > 1e-3) error = std::min(error, std::abs(fast.measures[m] - slow.measures[m]) / variation);
      (to_string(m).front() == 'I' ? errors.integral : errors.variation).take(error, loop, m);
    }
  }
  return errors;
}

TEST(Cascade, EqualsTheReferenceOnEveryInstructionSet) {
  for (const auto* implementation : available_implementations()) {
    SCOPED_TRACE(implementation->name);
    const CascadeErrors errors = errors_over_cascades(*implementation, kLoops, 7);
    EXPECT_LT(errors.integral.error, 1e-8) << errors.integral.where;
    EXPECT_LT(errors.variation.error, 1e-7) << errors.variation.where;
    EXPECT_LE(errors.unresolved, kLoops / 100);
    EXPECT_EQ(errors.status_differs, 0);
  }
}

TEST(Cascade, AnAutomaticHorizonEndsWhereNothingIsLeft) {
  oracle::Random random(5);
  for (int i = 0; i < 40; ++i) {
    const Loop loop = random_cascade(random);
    const auto fast = measure_one(*available_implementations().back(), loop, Horizon::until_settled());
    if (!fast.resolved) continue;
    const auto slow = reference::measure(loop, Horizon::until_settled());
    EXPECT_EQ(fast.status, slow.status) << simulate_command(loop);
    for (const Measure m : {Measure::IAE_w, Measure::IAE_d, Measure::TV_uw, Measure::TV_yd})
      EXPECT_LT(error_of(fast.measures[m], slow.measures[m]), 1e-7)
          << to_string(m) << " of " << simulate_command(loop);
  }
}

/// A setting's numbers do not depend on who lies beside it, nor on where.
TEST(Cascade, NeighboursDoNotMatter) {
  oracle::Random random(3);
  std::vector<Setting> settings;
  LoopFamily family;
  while (settings.size() < 21) {
    const Loop loop = random_cascade(random);
    if (settings.empty()) family = loop.family;
    const Loop other{family, loop.setting};
    if (!why_invalid(other) && is_stable(open_loop(other))) settings.push_back(loop.setting);
  }
  const auto& implementation = *available_implementations().back();
  std::vector<kernel::Measured> together(settings.size());
  kernel::measure(implementation, family, Horizon::fixed(20), settings, together);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    kernel::Measured alone;
    kernel::measure(implementation, family, Horizon::fixed(20), {&settings[i], 1}, {&alone, 1});
    for (const Measure m : standard_measures()) {
      const double a = alone.measures[m], b = together[i].measures[m];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << to_string(m) << " of setting " << i;
    }
  }
}

/// One lag, and a PID controller in the words of gains, are loops of the basic families.
TEST(Cascade, EqualsTheBasicFamilies) {
  const Setting pid{.kappa = 0.9, .tau_i = 1.7, .delta = 0.35, .tau_1 = 1.2, .tau_f = 0.1};
  const Loop basic{{.plant = Plant::fotd, .n = 2, .prefilter = Prefilter::none}, pid};
  Loop jotd = basic, gains = basic;
  jotd.family.plant = Plant::jotd, jotd.family.j = 1, jotd.setting.tau_1 = 0, jotd.setting.tau_j = 1.2;
  gains.family.m = 1, gains.setting.kappa = gains.setting.delta = 0, gains.setting.tau_i = kInf;
  gains.setting.gains = {0.9 / 1.7, 0.9, 0.35};
  const auto& implementation = *available_implementations().back();
  const auto expected = measure_one(implementation, basic, Horizon::fixed(25));
  for (const Loop& loop : {jotd, gains}) {
    ASSERT_EQ(why_invalid(loop), std::nullopt);
    const auto found = measure_one(implementation, loop, Horizon::fixed(25));
    for (const Measure m : response_measures())
      EXPECT_LT(error_of(found.measures[m], expected.measures[m]), 1e-9) << to_string(m);
  }
}

TEST(Cascade, WithoutMarginsAllElseIsTheSame) {
  oracle::Random random(19);
  const auto& implementation = *available_implementations().back();
  for (int i = 0; i < 20; ++i) {
    Loop loop = random_cascade(random);
    if (i % 4 == 0)
      for (double& K : loop.setting.gains) K *= 8;  // most of these are unstable
    kernel::Measured with, without;
    kernel::measure(implementation, loop.family, Horizon::fixed(20), {&loop.setting, 1}, {&with, 1});
    kernel::measure(implementation, loop.family, Horizon::fixed(20), {&loop.setting, 1}, {&without, 1}, false);
    EXPECT_EQ(with.status, without.status);
    for (const Measure m : response_measures())
      EXPECT_EQ(error_of(without.measures[m], with.measures[m]), 0) << to_string(m);
    const bool searched = loop.family.plant != Plant::jotd || loop.family.j > 1 || has_gains(loop.family);
    EXPECT_TRUE(!searched || std::isnan(without.measures[Measure::Ms]));
    EXPECT_EQ(std::isnan(with.measures[Measure::Ms]), with.status == Status::unstable);
  }
}

TEST(Cascade, MarginsAreThoseOfTheExactSearch) {
  oracle::Random random(11);
  for (int i = 0; i < 50; ++i) {
    const Loop loop = random_cascade(random);
    kernel::Measured found;
    kernel::measure(*available_implementations().back(), loop.family, Horizon::fixed(5), {&loop.setting, 1},
                    {&found, 1});
    MeasureRow expected;
    measure_loop(open_loop(general(loop)), expected);
    for (const Measure m : {Measure::Ms, Measure::Mt, Measure::GM, Measure::PM, Measure::DM})
      EXPECT_TRUE(found.measures[m] == expected[m] || std::abs(found.measures[m] / expected[m] - 1) < 1e-8)
          << to_string(m) << " of " << simulate_command(loop);
  }
}

}  // namespace
}  // namespace portrait
