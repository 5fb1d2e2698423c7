// Margins of loops of many lags or of gains in lanes against the exact search of engine/loop, on every instruction set.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/engine/kernel/lane_margins.h"
#include "tests/oracle/random_cascades.h"

namespace portrait {
namespace {

class CascadeMargins : public LaneMargins {};
INSTANTIATE_TEST_SUITE_P(EveryIsa, CascadeMargins, ::testing::ValuesIn(available_implementations()), isa_name);

bool is_cascade(const Loop& loop) {
  return has_gains(loop.family) || (loop.family.plant == Plant::jotd && loop.family.j != 1);
}

Loop cascade(oracle::Random& random) {
  while (true) {
    const Loop loop = oracle::random_cascade(random);
    if (is_cascade(loop)) return loop;
  }
}

/// Gains far from where a rule puts them: complex zeros, |L| that rises, stable or not.
Loop wild_cascade(oracle::Random& random) {
  while (true) {
    Loop loop = cascade(random);
    Setting& s = loop.setting;
    const double spread = random.chance(0.5) ? 1.5 : 5;
    for (double& gain : s.gains) gain *= random.log_uniform(1 / spread, spread);
    s.kappa *= random.log_uniform(0.2, 5), s.delta *= random.log_uniform(0.1, 10),
        s.tau_i *= random.log_uniform(0.3, 3);
    s.tau_f *= random.log_uniform(0.1, 10);
    if (!why_invalid(loop)) return loop;
  }
}

TEST_P(CascadeMargins, AreThoseOfTheExactSearch) {
  oracle::Random random(21);
  for (int i = 0; i < 600; ++i) expect_exact(cascade(random));
}

TEST_P(CascadeMargins, AreExactForWildLoops) {
  oracle::Random random(22);
  int stable = 0, rises = 0;
  for (int i = 0; i < 1500; ++i) {
    const Loop loop = wild_cascade(random);
    expect_exact(loop);
    if (!is_stable(open_loop(loop))) continue;
    ++stable;
    rises += gain_extremes(open_loop(loop)).empty() ? 0 : 1;
  }
  EXPECT_GT(stable, 600);
  EXPECT_GT(rises, 200);
}

/// c_0, c_1, ... from K_-1 on, over jotd of order j.
Loop with_numerator(int j, double tau_j, double tau_f, const std::vector<double>& c) {
  const int m = static_cast<int>(c.size()) - 2;
  Loop loop{{.plant = Plant::jotd, .n = std::max(m, 1), .prefilter = Prefilter::none, .j = j, .m = m},
            {.tau_f = tau_f, .tau_j = tau_j}};
  std::copy(c.begin(), c.end(), loop.setting.gains.begin());
  return loop;
}

/// Slow lags turn L past -pi, three zeros turn it back before |L| = 1: what has a lower gain margin.
TEST_P(CascadeMargins, OfLoopsThatLagAndLeadAgain) {
  oracle::Random random(27);
  int low_ones = 0;
  for (int i = 0; i < 600; ++i) {
    const double lag = random.log_uniform(40, 120), per_zero = random.log_uniform(6, 15),
                 omega = random.uniform(0.2, 0.5);
    const double K = omega * std::pow(std::hypot(1, lag * omega) / std::hypot(1, per_zero * omega), 3);
    const Loop loop = with_numerator(3, lag, random.log_uniform(0.01, 0.1),
                                     {K, 3 * K * per_zero, 3 * K * per_zero * per_zero, K * std::pow(per_zero, 3)});
    expect_exact(loop);
    const auto found = margins_of(loop);
    low_ones += found.stable && found.measures[Measure::GM_low] > 0 ? 1 : 0;
  }
  EXPECT_GT(low_ones, 60);
}

/// Zeros of little damping below the crossover: |L| falls, rises and falls again, and comes nearest to -1 at either end.
TEST_P(CascadeMargins, OfLoopsWithANotchBelowTheCrossover) {
  oracle::Random random(28);
  int notches = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double notch = random.log_uniform(0.1, 1.5), damping = random.uniform(0.1, 0.65);
    const double K = random.log_uniform(0.3, 4) * notch;
    const Loop loop = with_numerator(1 + random.below(4), random.log_uniform(0.1, 2), random.log_uniform(0.02, 0.2),
                                     {K, 2 * damping * K / notch, K / (notch * notch)});
    const OpenLoop open = open_loop(loop);
    const std::vector<double> crossovers = gain_crossovers(open), extremes = gain_extremes(open);
    if (!is_stable(open) || crossovers.size() != 1 || extremes.empty() || extremes.front() > crossovers[0])
      continue;
    ++notches;
    expect_exact(loop);
  }
  EXPECT_GT(notches, 30);
}

/// By the loop's own count of unstable roots, which knows nothing of margins.
TEST_P(CascadeMargins, GainMarginsAreWhereStabilityEnds) {
  oracle::Random random(23);
  const auto stable_with = [](Loop loop, double factor) {
    for (double& gain : loop.setting.gains) gain *= factor;
    loop.setting.kappa *= factor, loop.setting.delta *= factor;
    return is_stable(open_loop(loop));
  };
  for (int i = 0; i < 400; ++i) {
    const Loop loop = wild_cascade(random);
    const auto found = margins_of(loop);
    if (!found.stable || !(found.measures[Measure::GM] < 1e6)) continue;
    const double GM = found.measures[Measure::GM];
    EXPECT_TRUE(stable_with(loop, GM * (1 - 1e-8))) << simulate_command(loop);
    EXPECT_FALSE(stable_with(loop, GM * (1 + 1e-8))) << simulate_command(loop);
  }
}

std::vector<Setting> alike(oracle::Random& random, const Loop& loop, int count) {
  std::vector<Setting> settings;
  while (static_cast<int>(settings.size()) < count) {
    Loop other = loop;
    for (double& gain : other.setting.gains) gain *= random.log_uniform(0.7, 1.4);
    other.setting.kappa *= random.log_uniform(0.5, 2), other.setting.tau_j *= random.log_uniform(0.5, 2);
    if (random.chance(0.2)) other.setting.gains[0] = 0, other.setting.tau_i = kInf;
    if (!why_invalid(other)) settings.push_back(other.setting);
  }
  return settings;
}

/// A setting's bits do not depend on what stands beside it, nor whether it has integral action.
TEST_P(CascadeMargins, NeighboursDoNotMatter) {
  oracle::Random random(24);
  for (int k = 0; k < 20; ++k) {
    const Loop loop = cascade(random);
    expect_same_alone(*GetParam(), loop.family, alike(random, loop, 40));
  }
}

int lanes_known, lanes_seen;
const kernel::Implementation* counted_set;

void count_known(const kernel::CascadeMarginPack& pack, kernel::MarginResult& result) {
  counted_set->find_cascade_margins(pack, result);
  for (int lane = 0; lane < counted_set->lanes; ++lane) ++lanes_seen, lanes_known += result.known[lane] > 0 ? 1 : 0;
}

/// What the lanes leave to the exact search costs many times as much.
TEST_P(CascadeMargins, FewLoopsAreLeftOver) {
  oracle::Random random(25);
  counted_set = GetParam(), lanes_known = lanes_seen = 0;
  kernel::Implementation counting = *GetParam();
  counting.find_cascade_margins = count_known;
  int settings = 0;
  for (int k = 0; k < 30; ++k) {
    const Loop loop = cascade(random);
    const std::vector<Setting> near = alike(random, loop, 16);
    std::vector<kernel::LoopMargins> found(near.size());
    kernel::find_margins(counting, loop.family, near, found);
    for (const kernel::LoopMargins& m : found) settings += m.stable ? 1 : 0;
  }
  EXPECT_GT(lanes_seen, settings * 9 / 10) << "of " << settings << " stable ones so many came into lanes";
  EXPECT_GT(lanes_known, lanes_seen * 99 / 100);
}

/// To 1e-12, as tests/engine/kernel/hard_margins_test.cpp has it of the basic families.
TEST(InstructionSetsOfCascades, GiveTheSameMargins) {
  const auto sets = available_implementations();
  if (sets.size() < 2) GTEST_SKIP() << "this machine has one instruction set";
  oracle::Random random(26);
  for (int i = 0; i < 600; ++i) expect_same_on(sets, cascade(random));
}

}  // namespace
}  // namespace portrait
