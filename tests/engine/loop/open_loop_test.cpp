#include "engine/loop/open_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "tests/engine/loop/peak_scan.h"
#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

using Complex = std::complex<double>;

constexpr int kLoops = 500;

template <typename Check>
void for_random_loops(std::uint64_t seed, Check check) {
  RandomLoops random(seed);
  for (int i = 0; i < kLoops; ++i) {
    const Loop loop = random.next();
    SCOPED_TRACE(simulate_command(loop));
    check(loop, open_loop(loop), random);
    if (testing::Test::HasFailure()) return;
  }
}

/// Of loops with real poles.
std::vector<double> lags(const OpenLoop& open) {
  std::vector<double> T;
  for (const Quadratic& f : open.poles) T.push_back(f.b == 0 ? f.a : kNaN);
  return T;
}

TEST(OpenLoop, HasTheLoopsFactors) {
  const Setting s{.kappa = 0.5, .tau_i = 4, .delta = 0.25, .tau_1 = 3, .tau_f = 0.1};
  const OpenLoop fotd = open_loop({{Plant::fotd, 2, Prefilter::none}, s});
  EXPECT_EQ(fotd.gain, 0.125);
  EXPECT_EQ(fotd.integrators, 1);
  ASSERT_EQ(fotd.zeros.size(), 2u);  // of 1 + 4 s + 2 s^2
  EXPECT_NEAR(fotd.zeros[0].a + fotd.zeros[1].a, 4, 1e-15);
  EXPECT_NEAR(fotd.zeros[0].a * fotd.zeros[1].a, 2, 1e-15);
  EXPECT_EQ(lags(fotd), (std::vector<double>{3, 0.1, 0.1}));

  Setting pd = s;
  pd.tau_i = kInf;
  const OpenLoop dipdt = open_loop({{Plant::dipdt, 0, Prefilter::none}, pd});
  EXPECT_EQ(dipdt.gain, 0.5);
  ASSERT_EQ(dipdt.zeros.size(), 1u);
  EXPECT_EQ(dipdt.zeros[0].a, 0.5);
  EXPECT_EQ(dipdt.integrators, 2);
  EXPECT_TRUE(dipdt.poles.empty());
}

TEST(OpenLoop, ResponseIsControllerTimesFilterTimesPlant) {
  for_random_loops(10, [](const Loop& loop, const OpenLoop& open, RandomLoops& random) {
    const double omega = random.log_uniform(1e-4, 1e3);
    const Complex expected = open_loop_as_written(loop, omega);
    EXPECT_LE(std::abs(response_at(open, omega) - expected), 1e-13 * std::abs(expected));
    EXPECT_NEAR(gain_at(open, omega), std::abs(expected), 1e-13 * std::abs(expected));
  });
}

TEST(OpenLoop, LogSlopeIsTheDerivative) {
  for_random_loops(11, [](const Loop& loop, const OpenLoop& open, RandomLoops& random) {
    const double omega = random.log_uniform(1e-3, 1e2), h = 1e-4 * std::min(omega, 1.0);
    const auto L = [&](double w) { return open_loop_as_written(loop, w); };
    const Complex slope = (8.0 * (L(omega + h) - L(omega - h)) - L(omega + 2 * h) + L(omega - 2 * h)) / (12 * h);
    EXPECT_LE(std::abs(log_slope_at(open, omega) - slope / L(omega)),
              1e-9 * (1 / omega + std::abs(slope / L(omega))));
  });
}

TEST(OpenLoop, PhaseIsContinuousAndThatOfTheResponse) {
  for_random_loops(12, [](const Loop&, const OpenLoop& open, RandomLoops&) {
    double last = phase_at(open, 1e-7);
    EXPECT_NEAR(last, -open.integrators * std::numbers::pi / 2, 1e-3);
    for (double omega = 1e-7; omega < 30; omega *= 1.02) {
      const double phase = phase_at(open, omega);
      EXPECT_LE(std::abs(phase - last), 1.5 + 0.02 * omega);
      EXPECT_LE(std::abs(std::polar(gain_at(open, omega), phase) - response_at(open, omega)),
                1e-13 * gain_at(open, omega));
      last = phase;
    }
  });
}

/// Points at which a function sampled along the axis changes its sign.
template <typename Function>
std::size_t sign_changes_by_scan(Function f) {
  std::size_t changes = 0;
  double omega = 1e-6;
  for (bool last = f(omega) < 0; omega < 1e6; omega *= 1.003) {
    const bool here = f(omega) < 0;
    changes += here != last;
    last = here;
  }
  return changes;
}

TEST(OpenLoop, CrossoversAreWhereTheGainIsOne) {
  for_random_loops(13, [](const Loop&, const OpenLoop& open, RandomLoops&) {
    const std::vector<double> crossovers = gain_crossovers(open);
    for (const double omega : crossovers) EXPECT_NEAR(gain_at(open, omega), 1, 1e-12);
    EXPECT_TRUE(std::is_sorted(crossovers.begin(), crossovers.end()));
  });
}

TEST(OpenLoop, NoCrossoverIsMissed) {
  RandomLoops random(14);
  for (int i = 0; i < 100; ++i) {
    const Loop loop = random.next();
    const OpenLoop open = open_loop(loop);
    EXPECT_EQ(gain_crossovers(open).size(), sign_changes_by_scan([&](double w) { return gain_at(open, w) - 1; }))
        << simulate_command(loop);
  }
}

TEST(OpenLoop, ExtremesAreWhereTheGainHasNoSlope) {
  for_random_loops(15, [](const Loop&, const OpenLoop& open, RandomLoops&) {
    for (const double omega : gain_extremes(open)) {
      const double slope_per_octave = log_slope_at(open, omega).real() * omega;
      EXPECT_NEAR(slope_per_octave, 0, 1e-7);
    }
  });
}

TEST(OpenLoop, NoExtremeIsMissed) {
  RandomLoops random(16);
  for (int i = 0; i < 100; ++i) {
    const Loop loop = random.next();
    const OpenLoop open = open_loop(loop);
    const auto slope = [&](double w) { return log_slope_at(open, w).real(); };
    EXPECT_EQ(gain_extremes(open).size(), sign_changes_by_scan(slope)) << simulate_command(loop);
  }
}

TEST(OpenLoop, GainSquaredIsTheRatioOfThePolynomials) {
  for_random_loops(17, [](const Loop&, const OpenLoop& open, RandomLoops& random) {
    const double omega = random.log_uniform(1e-3, 1e2), x = omega * omega;
    const double squared = value(numerator_squared(open), x) / value(denominator_squared(open), x);
    const double gain = gain_at(open, omega);
    double cancelled = 1;
    for (const Quadratic& f : open.zeros)
      cancelled *= std::pow((1 + f.a * omega + f.b * x) / std::abs(Complex(1 - f.b * x, f.a * omega)), 2);
    EXPECT_NEAR(squared, gain * gain, 1e-14 * cancelled * gain * gain);
  });
}

TEST(OpenLoop, LimitsOfTheGain) {
  const Setting pid{.kappa = 0.5, .tau_i = 4, .delta = 0.25, .tau_1 = 2, .tau_f = 0.1};
  Setting pd = pid, p = pid;
  pd.tau_i = kInf;
  p.tau_i = kInf, p.delta = 0;
  const auto low = [](Plant plant, int n, const Setting& s) {
    return low_frequency_gain(open_loop({{plant, n, Prefilter::none}, s}));
  };
  const auto high = [](Plant plant, int n, const Setting& s) {
    return high_frequency_gain(open_loop({{plant, n, Prefilter::none}, s}));
  };
  EXPECT_EQ(low(Plant::fotd, 0, p), 0.5);
  EXPECT_EQ(low(Plant::fotd, 0, pid), kInf);
  EXPECT_EQ(low(Plant::ipdt, 0, p), kInf);
  for (const Setting& s : {pid, pd}) {
    EXPECT_EQ(high(Plant::dipdt, 0, s), 0);
    EXPECT_EQ(high(Plant::ipdt, 0, s), 0.25);
    EXPECT_EQ(high(Plant::fotd, 0, s), 0.125);
    EXPECT_EQ(high(Plant::ipdt, 1, s), 0);
    EXPECT_EQ(high(Plant::fotd, 1, s), 0);
  }
  EXPECT_EQ(high(Plant::fotd, 0, p), 0);
}

}  // namespace
}  // namespace portrait
