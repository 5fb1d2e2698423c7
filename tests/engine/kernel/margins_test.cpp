// Stability, peaks and margins in lanes against the exact search of engine/loop, on every instruction set.
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "tests/engine/kernel/lane_margins.h"

namespace portrait {
namespace {

INSTANTIATE_TEST_SUITE_P(EveryIsa, LaneMargins, ::testing::ValuesIn(available_implementations()), isa_name);

bool stable_with_gain(Loop loop, double factor) {
  loop.setting.kappa *= factor;
  loop.setting.delta *= factor;
  return is_stable(open_loop(loop));
}

TEST_P(LaneMargins, AreThoseOfTheExactSearch) {
  oracle::Random random(3);
  for (int i = 0; i < 2000; ++i) expect_exact(random_loop(random));
}

TEST_P(LaneMargins, GainMarginsAreWhereStabilityEnds) {
  oracle::Random random(4);
  int low_ones = 0;
  for (int i = 0; i < 1000; ++i) {
    const Loop loop = random_loop(random);
    const auto found = margins_of(loop);
    if (!found.stable) continue;
    const double GM = found.measures[Measure::GM], GM_low = found.measures[Measure::GM_low];
    if (GM < 1e6) {
      EXPECT_TRUE(stable_with_gain(loop, GM * (1 - 1e-8))) << simulate_command(loop);
      EXPECT_FALSE(stable_with_gain(loop, GM * (1 + 1e-8))) << simulate_command(loop);
    }
    if (GM_low < 1e-9) continue;
    ++low_ones;
    EXPECT_TRUE(stable_with_gain(loop, GM_low * (1 + 1e-8))) << simulate_command(loop);
    EXPECT_FALSE(stable_with_gain(loop, GM_low * (1 - 1e-8))) << simulate_command(loop);
  }
  EXPECT_GT(low_ones, 100);
}

/// P control of an integrator: everything in closed form.
TEST_P(LaneMargins, ProportionalControlOfAnIntegrator) {
  for (const double kappa : {0.1, 0.5, 1.0, 1.5}) {
    const kernel::MarginRow found = margins_of({{Plant::ipdt, 0, Prefilter::none}, {.kappa = kappa}}).measures;
    EXPECT_NEAR(found[Measure::GM], M_PI_2 / kappa, 1e-12);
    EXPECT_EQ(found[Measure::GM_low], 0);
    EXPECT_NEAR(found[Measure::PM], 90 - kappa * 180 / M_PI, 1e-11);
    EXPECT_NEAR(found[Measure::DM], (M_PI_2 - kappa) / kappa, 1e-12);
  }
}

/// A loop with a root of D(s) + N(s) e^{-s} at s = j omega, for gains as they come: the real and imaginary part of
/// N(j omega) = -D(j omega) e^{j omega} give two of them, delta or none is chosen.
struct OnTheLimit {
  Loop loop;
  double rises;  ///< Re ds/dg: whether the root goes to the right with the gain g
};

std::complex<double> denominator(const OpenLoop& loop, std::complex<double> s) {
  std::complex<double> D = std::pow(s, loop.integrators);
  for (const Quadratic& f : loop.poles) D *= 1.0 + s * (f.a + s * f.b);
  return D;
}

std::optional<OnTheLimit> loop_on_the_limit(oracle::Random& random, double omega) {
  Loop loop = random_loop(random);
  Setting& s = loop.setting;
  const std::complex<double> jw(0, omega), turned = -denominator(open_loop(loop), jw) * std::exp(jw);
  if (has_integral_action(s)) {
    s.kappa = turned.imag() / omega;
    s.tau_i = s.kappa / (turned.real() + s.delta * omega * omega);
  } else {
    s.kappa = turned.real();
    s.delta = turned.imag() / omega;
  }
  if (!(s.kappa > 0 && s.tau_i > 0 && s.delta >= 0) || why_invalid(loop)) return std::nullopt;
  const OpenLoop open = open_loop(loop);
  if (high_frequency_gain(open) > 0.99) return std::nullopt;
  const double n0 = has_integral_action(s) ? s.kappa / s.tau_i : s.kappa,
               n1 = has_integral_action(s) ? s.kappa : s.delta, n2 = has_integral_action(s) ? s.delta : 0;
  const std::complex<double> N = n0 + jw * (n1 + jw * n2), turn = std::exp(-jw);
  std::complex<double> slope = n1 + 2.0 * n2 * jw - N;  // (N' - N) e^{-s} + D', D'/D summed factor by factor
  std::complex<double> growth = static_cast<double>(open.integrators) / jw;
  for (const Quadratic& f : open.poles) growth += f.a / (1.0 + f.a * jw);  // lags
  const double rises = (-N * turn / (slope * turn + denominator(open, jw) * growth)).real();
  if (std::abs(rises) < 1e-3) return std::nullopt;
  return OnTheLimit{loop, rises};
}

Loop with_gain(Loop loop, double factor) {
  loop.setting.kappa *= factor;
  loop.setting.delta *= factor;
  return loop;
}

/// 100,000 settings, gains 1e-6 below and above a limit that the quasi-polynomial itself gives. The side to which the root
/// moves is never stable; the other one is stable just where the exact count says so.
TEST_P(LaneMargins, TheStabilityLimitIsExact) {
  oracle::Random random(6);
  int settings = 0, with_a_stable_side = 0;
  while (settings < 100'000) {
    const auto limit = loop_on_the_limit(random, random.log_uniform(0.05, 4));
    if (!limit) continue;
    settings += 2;
    const Loop left = with_gain(limit->loop, 1 - 1e-6), right = with_gain(limit->loop, 1 + 1e-6);
    const Loop& unstable = limit->rises > 0 ? right : left;
    const Loop& other = limit->rises > 0 ? left : right;
    ASSERT_FALSE(margins_of(unstable).stable) << simulate_command(unstable);
    const bool stable = margins_of(other).stable;
    ASSERT_EQ(stable, is_stable(open_loop(other))) << simulate_command(other);
    with_a_stable_side += stable ? 1 : 0;
  }
  EXPECT_GT(with_a_stable_side, 10'000);
}

/// A setting's bits do not depend on what stands beside it.
TEST_P(LaneMargins, NeighboursDoNotMatter) {
  oracle::Random random(9);
  for (const LoopFamily family : {LoopFamily{Plant::dipdt, 1, Prefilter::full},
                                  {Plant::fotd, 0, Prefilter::pi},
                                  {Plant::fotd, 2, Prefilter::none},
                                  {Plant::ipdt, 4, Prefilter::none}}) {
    std::vector<Setting> settings;
    for (int i = 0; i < 2000; ++i) {
      settings.push_back(oracle::random_controller(random, family.plant, random.log_uniform(0.1, 10)));
      settings.back().tau_f = random.log_uniform(0.01, 1);
    }
    expect_same_alone(*GetParam(), family, settings);
  }
}

/// A grid whose neighbours have their crossovers at different steps of the march.
TEST_P(LaneMargins, NeighboursOnAGridDoNotMatter) {
  std::vector<Setting> settings;
  for (int i = 0; i <= 80; ++i)
    for (int k = 0; k <= 40; ++k)
      for (const double tau_i : {6.0, 8.0, 10.0, 14.0, 20.0})
        for (const double tau_f : {0.05, 0.1})
          settings.push_back({.kappa = 0.05 + 0.00375 * i, .tau_i = tau_i, .delta = 0.35 + 0.0175 * k, .tau_f = tau_f});
  expect_same_alone(*GetParam(), {Plant::dipdt, 1, Prefilter::full}, settings);
}

}  // namespace
}  // namespace portrait
