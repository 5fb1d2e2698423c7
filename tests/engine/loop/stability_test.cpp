#include "engine/loop/stability.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/base/check.h"
#include "engine/loop/parameters.h"
#include "tests/engine/loop/random_loops.h"
#include "tests/engine/loop/root_count.h"

namespace portrait {
namespace {

using std::numbers::pi;

constexpr double kHair = 1e-9;

Loop p_loop(Plant plant, double kappa, double tau_1 = 0) {
  return {{plant, 0, Prefilter::none}, {.kappa = kappa, .tau_1 = tau_1}};
}

bool stable(const Loop& loop) { return is_stable(open_loop(loop)); }
int unstable(const Loop& loop) { return unstable_roots(open_loop(loop)); }

Loop with_gain_times(Loop loop, double factor) {
  loop.setting.kappa *= factor;
  loop.setting.delta *= factor;
  return loop;
}

TEST(Stability, ProportionalControlOfIpdtEndsAtHalfPi) {
  EXPECT_TRUE(stable(p_loop(Plant::ipdt, pi / 2 * (1 - kHair))));
  EXPECT_FALSE(stable(p_loop(Plant::ipdt, pi / 2 * (1 + kHair))));
  EXPECT_EQ(unstable(p_loop(Plant::ipdt, pi / 2 * (1 + kHair))), 2);
}

/// s + kappa e^{-s} has a further pair j omega at every omega = kappa = pi/2 + 2 pi k.
TEST(Stability, EveryFurtherTurnOfIpdtAddsAPair) {
  for (int k = 0; k < 50; ++k) {
    const double limit = pi / 2 + 2 * pi * k;
    EXPECT_EQ(unstable(p_loop(Plant::ipdt, limit * (1 - kHair))), 2 * k);
    EXPECT_EQ(unstable(p_loop(Plant::ipdt, limit * (1 + kHair))), 2 * k + 2);
  }
}

/// A pair a turn: beyond what an int holds they are not counted any more.
TEST(Stability, MoreRootsThanCanBeCountedAreTheMostThatAre) {
  EXPECT_EQ(unstable(p_loop(Plant::ipdt, 1e8)), 2 * static_cast<int>(std::floor((1e8 - pi / 2) / (2 * pi))) + 2);
  for (const double kappa : {1e10, 1e15, 1e25, 1e130}) {
    EXPECT_EQ(unstable(p_loop(Plant::ipdt, kappa)), kMostRoots) << kappa;
    EXPECT_FALSE(stable(p_loop(Plant::ipdt, kappa))) << kappa;
  }
}

/// tau_1 j omega + 1 + kappa e^{-j omega} = 0: tan omega = -tau_1 omega, kappa = -1/cos omega.
TEST(Stability, ProportionalControlOfFotdEndsWhereTheTangentSays) {
  for (const double tau_1 : {0.01, 0.3, 1.0, 10.0, 1000.0}) {
    double low = pi / 2, high = pi;
    for (int i = 0; i < 100; ++i) {
      const double middle = (low + high) / 2;
      (std::sin(middle) + tau_1 * middle * std::cos(middle) > 0 ? low : high) = middle;
    }
    const double limit = -1 / std::cos(low);
    EXPECT_TRUE(stable(p_loop(Plant::fotd, limit * (1 - kHair), tau_1))) << tau_1;
    EXPECT_EQ(unstable(p_loop(Plant::fotd, limit * (1 + kHair), tau_1)), 2) << tau_1;
  }
}

/// A gain below 1 everywhere needs no crossover to be stable; a gain of exactly 1 at rest starts at the edge.
TEST(Stability, OfFotdWithLittleGain) {
  for (const double kappa : {1e-6, 0.5, 1.0}) EXPECT_TRUE(stable(p_loop(Plant::fotd, kappa, 1)));
}

TEST(Stability, AGainThatRisesFromExactlyOne) {
  Loop loop{{Plant::fotd, 1, Prefilter::none}, {.kappa = 1, .delta = 2, .tau_1 = 0.5, .tau_f = 0.1}};
  EXPECT_EQ(unstable(loop), unstable_roots_by_contour(loop));
  loop.setting.delta = 0.55;
  EXPECT_EQ(unstable(loop), unstable_roots_by_contour(loop));
}

TEST(Stability, DipdtIsNeverStableWithoutDerivative) {
  for (const double kappa : {1e-6, 1e-3, 1.0})
    for (const double tau_i : {1.0, 100.0, kInf})
      EXPECT_FALSE(stable({{Plant::dipdt, 0, Prefilter::none}, {.kappa = kappa, .tau_i = tau_i}}));
}

TEST(Stability, OfTheTuningsOfTheMultipleRealPole) {  // [Huba2022 (15), (22)]
  EXPECT_TRUE(stable({{Plant::dipdt, 0, Prefilter::pi}, {.kappa = 0.079, .delta = 0.461}}));
  EXPECT_TRUE(stable({{Plant::dipdt, 0, Prefilter::pi}, {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045}}));
}

/// A controller of the given integral time and angle at omega, with the gain that puts a root on j omega:
/// L(j omega) = -1 asks of kappa (1 + j (tau_d omega - 1/(tau_i omega))) that its angle undo that of Q P e^{-s}.
class Boundary {
 public:
  explicit Boundary(std::uint64_t seed) : random_(seed) {}

  /// A loop of this plant with a root at some j omega; PI when `proportional_integral`, else PD or PID.
  Loop next(Plant plant, bool proportional_integral) {
    for (;;)
      if (const auto loop = attempt(plant, proportional_integral)) return *loop;
  }

 private:
  std::optional<Loop> attempt(Plant plant, bool proportional_integral) {
    Loop loop{{plant, random_.index(5), Prefilter::none}, {.kappa = 1}};
    Setting& s = loop.setting;
    s.tau_f = random_.log_uniform(1e-3, 10);
    s.tau_1 = random_.log_uniform(1e-2, 100);
    const double omega = random_.log_uniform(0.01, 10);
    const std::complex<double> rest = response_at(open_loop(loop), omega);  // kappa = 1, P alone
    const std::complex<double> needed = -1.0 / rest;
    if (needed.real() <= 0) return std::nullopt;
    const double tangent = needed.imag() / needed.real();
    double derivative_time = 0;
    if (proportional_integral) {
      s.tau_i = -1 / (tangent * omega);
    } else {
      s.tau_i = random_.chance(0.3) ? kInf : random_.log_uniform(1, 100);
      derivative_time = (tangent + 1 / (s.tau_i * omega)) / omega;
    }
    if (!(s.tau_i > 0) || derivative_time < 0) return std::nullopt;
    s.kappa = needed.real();
    s.delta = s.kappa * derivative_time;
    const OpenLoop open = open_loop(loop);
    if (high_frequency_gain(open) > 0.99) return std::nullopt;
    // A hair of gain must turn the phase at the crossover by more than rounding does.
    const std::complex<double> slope = log_slope_at(open, omega);
    if (std::abs(slope.imag() / slope.real()) * kHair < 1e-13) return std::nullopt;
    return loop;
  }

  RandomLoops random_;
};

void expect_a_pair_to_cross(const Loop& loop) {
  const Loop below = with_gain_times(loop, 1 - kHair), above = with_gain_times(loop, 1 + kHair);
  EXPECT_EQ(std::abs(unstable(above) - unstable(below)), 2) << simulate_command(loop);
}

TEST(Stability, APairCrossesAtTheBoundaryOfPi) {
  Boundary boundary(20);
  for (const Plant plant : {Plant::ipdt, Plant::fotd})
    for (int i = 0; i < 1000; ++i) expect_a_pair_to_cross(boundary.next(plant, true));
}

TEST(Stability, APairCrossesAtTheBoundaryOfPdAndPid) {
  Boundary boundary(21);
  for (const Plant plant : {Plant::dipdt, Plant::ipdt, Plant::fotd})
    for (int i = 0; i < 1000; ++i) expect_a_pair_to_cross(boundary.next(plant, false));
}

TEST(Stability, TheFirstBoundaryParts) {
  Boundary boundary(22);
  int edges = 0;
  for (int i = 0; i < 1000; ++i) {
    const Loop loop = boundary.next(Plant::dipdt, false);
    const bool below = stable(with_gain_times(loop, 1 - kHair)), above = stable(with_gain_times(loop, 1 + kHair));
    EXPECT_FALSE(below && above);
    edges += below != above;
  }
  EXPECT_GT(edges, 50);
}

TEST(Stability, ANeutralLoopNeedsAHighFrequencyGainBelowOne) {
  const auto ipdt = [](double delta) {
    return Loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.01, .tau_i = 100, .delta = delta}};
  };
  EXPECT_TRUE(stable(ipdt(0.5)));
  EXPECT_TRUE(stable(ipdt(0.9)));
  for (const double delta : {1.0, 1 + kHair, 2.0}) EXPECT_FALSE(stable(ipdt(delta))) << delta;
  const auto fotd = [](double delta) {
    return Loop{{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.01, .tau_i = 100, .delta = delta, .tau_1 = 3}};
  };
  EXPECT_TRUE(stable(fotd(2.7)));
  for (const double delta : {3.0, 3 * (1 + kHair), 5.0}) EXPECT_FALSE(stable(fotd(delta))) << delta;
  EXPECT_THROW(unstable(ipdt(1)), BrokenPromise);
}

TEST(Stability, AFilterMakesTheLoopRetarded) {
  const Loop loop{{Plant::ipdt, 1, Prefilter::none}, {.kappa = 0.01, .tau_i = 100, .delta = 2, .tau_f = 0.01}};
  EXPECT_FALSE(stable(loop));
  EXPECT_EQ(unstable(loop), unstable_roots_by_contour(loop));
}

TEST(Stability, CountsAsTheContourDoes) {
  RandomLoops random(23);
  for (int i = 0; i < 1500; ++i) {
    const Loop loop = random.next();
    if (high_frequency_gain(open_loop(loop)) > 0.99) continue;
    ASSERT_EQ(unstable(loop), unstable_roots_by_contour(loop)) << simulate_command(loop);
  }
}

}  // namespace
}  // namespace portrait
