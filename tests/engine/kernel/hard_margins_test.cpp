// Loops whose peaks and margins are easily missed, on every instruction set: against the exact search, and against each
// other.
#include <algorithm>
#include <vector>

#include "tests/engine/kernel/lane_margins.h"

namespace portrait {
namespace {

using HardMargins = LaneMargins;

INSTANTIATE_TEST_SUITE_P(EveryIsa, HardMargins, ::testing::ValuesIn(available_implementations()), isa_name);

/// Parameters of a loop, each off by up to a part of itself.
Loop nearby(oracle::Random& random, Loop loop, double part) {
  for (double Setting::*p : {&Setting::kappa, &Setting::tau_i, &Setting::delta, &Setting::tau_1, &Setting::tau_f})
    loop.setting.*p *= 1 + part * random.uniform(-1, 1);
  return loop;
}

/// |T| is level to 1e-5 from omega = 0.33 to 0.42, with a peak at either end.
TEST_P(HardMargins, TwoPeaksOfALevelStretch) {
  const Loop level{{Plant::dipdt, 4, Prefilter::none},
                   {.kappa = 0.09910832346846077,
                    .tau_i = 8.418478643314605,
                    .delta = 0.5895824831651736,
                    .tau_f = 0.00868842365863047}};
  oracle::Random random(11);
  expect_exact(level);
  for (int i = 0; i < 300; ++i) expect_exact(nearby(random, level, random.log_uniform(1e-5, 0.02)));
}

/// arg L passes -pi and comes back within less than a step, far above the gain crossover.
TEST_P(HardMargins, APhaseThatTurnsAtTheLimit) {
  oracle::Random random(12);
  const Loop neutral{{Plant::fotd, 0, Prefilter::none},
                     {.kappa = 0.017060377997455814,
                      .tau_i = 0.1885754719095949,
                      .delta = 0.15325659323640572,
                      .tau_1 = 5.241618009867276}};
  const Loop filtered{{Plant::fotd, 2, Prefilter::none},
                      {.kappa = 0.0008769524264260475,
                       .tau_i = 1.563380518344068,
                       .delta = 0.01910886591359371,
                       .tau_1 = 48.77879441571082,
                       .tau_f = 1.664177542725989}};
  for (const Loop& loop : {neutral, filtered}) {
    expect_exact(loop);
    for (int i = 0; i < 300; ++i) expect_exact(nearby(random, loop, random.log_uniform(1e-4, 0.1)));
  }
}

/// Weakly damped zeros of the controller two decades below the gain crossover, where |L| is 30 and more: |T| peaks there.
TEST_P(HardMargins, APeakFarBelowTheCrossover) {
  const Loop loop{{Plant::dipdt, 3, Prefilter::none},
                  {.kappa = 0.0001488402345066059,
                   .tau_i = 65.01548393725021,
                   .delta = 0.5116570162922078,
                   .tau_f = 0.01692237717389371}};
  oracle::Random random(13);
  expect_exact(loop);
  for (int i = 0; i < 300; ++i) expect_exact(nearby(random, loop, random.log_uniform(1e-3, 0.3)));
}

/// Far beyond what anyone tunes: gains and time constants over many decades, up to 16 filters.
TEST_P(HardMargins, AreExactForWildLoops) {
  oracle::Random random(14);
  for (int i = 0; i < 3000; ++i) {
    const auto plant = static_cast<Plant>(random.below(3));
    Loop loop{{plant, random.chance(0.1) ? 5 + random.below(12) : random.below(5), Prefilter::none}, {}};
    constexpr double kLargestKappa[] = {0.5, 3, 20};
    loop.setting = {.kappa = random.log_uniform(1e-4, kLargestKappa[static_cast<std::size_t>(plant)]),
                    .tau_i = random.chance(0.2) ? kInf : random.log_uniform(0.05, 1000),
                    .delta = random.chance(0.2) ? 0 : random.log_uniform(1e-4, 5),
                    .tau_1 = plant == Plant::fotd ? random.log_uniform(1e-3, 1000) : 0,
                    .tau_f = loop.family.n > 0 ? random.log_uniform(1e-3, 10) : 0};
    expect_exact(loop);
  }
}

/// What the lanes leave to the exact search costs a hundred times as much.
TEST_P(HardMargins, FewLoopsAreLeftOver) {
  oracle::Random random(15);
  int left_over = 0;
  constexpr int kLoops = 4000;
  for (int i = 0; i < kLoops; ++i) {
    const Loop loop = oracle::random_stable_loop(random);
    const Setting& s = loop.setting;
    kernel::MarginPack pack{};
    pack.plant = static_cast<kernel::PlantKind>(loop.family.plant);
    pack.n = loop.family.n, pack.integral = has_integral_action(s);
    const auto fill = [](kernel::PackColumn& column, double x) {
      std::fill(std::begin(column), std::end(column), x);
    };
    fill(pack.kappa, s.kappa), fill(pack.tau_i, s.tau_i), fill(pack.delta, s.delta);
    fill(pack.tau_1, s.tau_1), fill(pack.tau_f, s.tau_f);
    kernel::MarginResult found;
    GetParam()->find_margins(pack, found);
    left_over += found.known[0] > 0 ? 0 : 1;
  }
  EXPECT_LT(left_over, kLoops / 200);
}

TEST(InstructionSets, GiveTheSameMargins) {
  const auto sets = available_implementations();
  if (sets.size() < 2) GTEST_SKIP() << "this machine has one instruction set";
  oracle::Random random(16);
  for (int i = 0; i < 3000; ++i) expect_same_on(sets, oracle::random_stable_loop(random));
}

}  // namespace
}  // namespace portrait
