// The promises of engine/kernel/noise.h: noise in lanes against the reference's noise of the same seeds, and against what is
// expected of it.
#include "engine/reference/noise.h"

#include <gtest/gtest.h>

#include "engine/kernel/measure.h"
#include "engine/loop/noise_gain.h"
#include "tests/engine/kernel/comparison.h"
#include "tests/oracle/random_cascades.h"

namespace portrait {
namespace {

using kernel::DrawnNoise;

#ifdef PORTRAIT_SANITIZED
constexpr int kLoops = 20;
#else
constexpr int kLoops = 80;
#endif

NoiseTrials trials(double sampling, int seeds, Noise::Kind kind = Noise::Kind::uniform) {
  return {{.kind = kind, .amplitude = 0.1, .sampling = sampling, .seed = 11}, seeds};
}

Loop random_proper_loop(oracle::Random& random) {
  while (true) {
    const Loop loop = random.chance(0.3) ? oracle::random_cascade(random) : oracle::random_stable_loop(random);
    if (loop.family.n > 0 ? loop.setting.tau_f > 0.01 : loop.setting.delta == 0) return loop;
  }
}

kernel::Measured measured(const kernel::Implementation& implementation, const Loop& loop, const DrawnNoise& noise) {
  kernel::Measured found;
  kernel::measure_under_noise(implementation, loop.family, {&loop.setting, 1}, noise, {&found, 1});
  return found;
}

/// TV under noise of the same signal, of which the others are parts.
double size_of(const MeasureRow& row, Measure m) {
  const std::string name(to_string(m));
  const auto variation = measure_named("noisy_TV_" + name.substr(name.rfind('_') + 1));
  return variation ? row[*variation] : row[Measure::sigma_ratio];
}

Loop dipdt_pid(double kappa, double tau_f = 0.2, Prefilter prefilter = Prefilter::full) {
  return {{Plant::dipdt, 1, prefilter}, {.kappa = kappa, .tau_i = 12, .delta = 0.55, .tau_f = tau_f}};
}

TEST(Noise, EqualsTheReferenceOfTheSameSeeds) {
  for (const auto* implementation : available_implementations()) {
    SCOPED_TRACE(implementation->name);
    oracle::Random random(3);
    int unresolved = 0;
    for (int i = 0; i < kLoops; ++i) {
      const Loop loop = random_proper_loop(random);
      // Sampling times that divide the dead time, that do not, and that are longer; horizons between instants.
      const double sampling = random.chance(0.5) ? 1.0 / (1 + random.below(20)) : random.log_uniform(0.03, 2.5);
      const double horizon = random.chance(0.5) ? 5 + random.below(30) : random.uniform(2.5, 40);
      const NoiseTrials three =
          trials(sampling, 3, random.chance(0.5) ? Noise::Kind::uniform : Noise::Kind::gaussian);
      const kernel::Measured fast = measured(*implementation, loop, DrawnNoise(three, horizon));
      unresolved += fast.resolved ? 0 : 1;
      if (!fast.resolved) continue;  // a sweep asks the reference
      MeasureRow slow;
      reference::measure_noise(loop, three, horizon, slow);
      for (const Measure m : noisy_measures())
        ASSERT_NEAR(fast.measures[m], slow[m], 1e-7 * size_of(slow, m))
            << to_string(m) << " at sampling " << sampling << ", horizon " << horizon << "\n"
            << simulate_command(loop);
    }
    EXPECT_LE(unresolved, kLoops / 20);
  }
}

TEST(Noise, TheDrawnOneAmplifiesAsExpected) {
  const Loop loop = dipdt_pid(0.12);
  const kernel::Measured found =
      measured(*available_implementations().back(), loop, DrawnNoise(trials(0.01, 40), 200));
  const double spread_of_mean = found.measures[Measure::spread_sigma_ratio] / std::sqrt(40.0);
  EXPECT_GT(spread_of_mean, 0);
  EXPECT_NEAR(found.measures[Measure::sigma_ratio], found.measures[Measure::expected_sigma_ratio],
              4 * spread_of_mean);
  EXPECT_LT(spread_of_mean, 0.01 * found.measures[Measure::sigma_ratio]);
  // noise_gain is its average over time: from instant to instant most of a value's answer fades with the filter.
  const double faded = 0.01 / loop.setting.tau_f, at_instants = std::sqrt(2 * faded / -std::expm1(-2 * faded));
  EXPECT_NEAR(found.measures[Measure::expected_sigma_ratio], at_instants * noise_gain(loop, 0.01), 5e-3);
}

TEST(Noise, WithoutDerivativeAndFilterTheExpectationIsClosed) {
  // Of a P controller on an integrator the first dead time's answer to a held value is a single pulse.
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.3, .tau_i = kInf}};
  const kernel::Measured found = measured(*available_implementations().back(), loop, DrawnNoise(trials(1, 1), 1.5));
  EXPECT_NEAR(found.measures[Measure::expected_sigma_ratio], 0.3, 1e-12)
      << "two instants, the later sees none of the first";
  EXPECT_TRUE(std::isnan(found.measures[Measure::spread_sigma_ratio])) << "of one seed";
}

TEST(Noise, NeighboursDoNotMatter) {
  const DrawnNoise noise(trials(0.13, 2), 30);
  std::vector<Setting> settings;
  for (int i = 0; i < 29; ++i) settings.push_back(dipdt_pid(0.05 + 0.005 * i, i % 3 == 0 ? 0.6 : 0.1).setting);
  const LoopFamily family = dipdt_pid(0.1).family;
  for (const auto* implementation : available_implementations()) {
    std::vector<kernel::Measured> together(settings.size());
    kernel::measure_under_noise(*implementation, family, settings, noise, together);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const kernel::Measured alone = measured(*implementation, {family, settings[i]}, noise);
      for (const Measure m : noisy_measures())
        EXPECT_EQ(alone.measures[m], together[i].measures[m]) << to_string(m);
    }
  }
}

TEST(Noise, TheOtherMeasuresKeepTheirBits) {
  oracle::Random random(8);
  for (int i = 0; i < 20; ++i) {
    const Loop loop = random_proper_loop(random);
    const auto& implementation = *available_implementations().back();
    const kernel::Measured with = measured(implementation, loop, DrawnNoise(trials(0.1, 1), 25));
    const kernel::Measured without = measure_one(implementation, loop, Horizon::fixed(25));
    EXPECT_EQ(with.status, without.status);
    for (const Measure m : response_measures())
      EXPECT_TRUE(error_of(with.measures[m], without.measures[m]) == 0) << to_string(m) << "\n"
                                                                        << simulate_command(loop);
  }
}

TEST(Noise, InstructionSetsAgree) {
  const DrawnNoise noise(trials(0.1, 3), 40);
  const auto all = available_implementations();
  for (const double kappa : {0.06, 0.1, 0.14}) {
    const kernel::Measured first = measured(*all.front(), dipdt_pid(kappa), noise);
    for (const auto* implementation : all) {
      const kernel::Measured other = measured(*implementation, dipdt_pid(kappa), noise);
      for (const Measure m : noisy_measures())
        EXPECT_NEAR(other.measures[m], first.measures[m], 1e-12 * size_of(first.measures, m)) << to_string(m);
    }
  }
}

}  // namespace
}  // namespace portrait
