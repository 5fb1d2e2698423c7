#include "engine/loop/real_plant.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "engine/loop/open_loop.h"
#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

using Complex = std::complex<double>;

constexpr std::array kPlants = {Plant::dipdt, Plant::ipdt, Plant::fotd};
constexpr std::array kPrefilters = {Prefilter::full, Prefilter::pi, Prefilter::none};

std::string reason(const RealPlant& plant) { return why_invalid(plant).value_or("valid"); }

TEST(RealPlant, WhyInvalid) {
  EXPECT_EQ(reason({Plant::dipdt, 2, 0.5, 0}), "valid");
  EXPECT_EQ(reason({Plant::dipdt, -2, 0.5, 0}), "valid");
  EXPECT_EQ(reason({Plant::dipdt, 0, 0.5, 0}), "K must be finite and not 0 (it is 0)");
  EXPECT_EQ(reason({Plant::dipdt, kNaN, 0.5, 0}), "K must be finite and not 0 (it is nan)");
  EXPECT_EQ(reason({Plant::dipdt, kInf, 0.5, 0}), "K must be finite and not 0 (it is inf)");
  EXPECT_EQ(reason({Plant::dipdt, 1, 0, 0}), "Td must be finite and above 0 (it is 0)");
  EXPECT_EQ(reason({Plant::dipdt, 1, -1, 0}), "Td must be finite and above 0 (it is -1)");
  EXPECT_EQ(reason({Plant::dipdt, 1, kInf, 0}), "Td must be finite and above 0 (it is inf)");
  EXPECT_EQ(reason({Plant::fotd, 1, 1, 0}), "T1 must be finite and above 0 (it is 0)");
  EXPECT_EQ(reason({Plant::fotd, 1, 1, kInf}), "T1 must be finite and above 0 (it is inf)");
  EXPECT_EQ(reason({Plant::fotd, 1, 1, 3}), "valid");
}

TEST(InputGain, IsWhatOneUnitOfInputBuildsUp) {
  EXPECT_EQ(input_gain({Plant::dipdt, 3, 2, 0}), 12);
  EXPECT_EQ(input_gain({Plant::ipdt, 3, 2, 0}), 6);
  EXPECT_EQ(input_gain({Plant::fotd, 3, 2, 5}), 3);
  EXPECT_EQ(input_gain({Plant::dipdt, -3, 2, 0}), -12);
}

TEST(Scale, FollowsTheUnitOfTheMeasure) {
  const RealPlant plant{Plant::dipdt, 3, 2, 0};  // g = 12
  EXPECT_EQ(scale(Measure::IAE_w, plant), 2);
  EXPECT_EQ(scale(Measure::IAE_d, plant), 12 * 2);  // K Td^3 as in [Huba2022 (27)]
  EXPECT_EQ(scale(Measure::ISE_d, plant), 12 * 12 * 2);
  EXPECT_EQ(scale(Measure::ITAE_w, plant), 2 * 2);
  EXPECT_EQ(scale(Measure::ITAE_d, plant), 12 * 2 * 2);
  EXPECT_EQ(scale(Measure::ITSE_d, plant), 12 * 12 * 2 * 2);
  EXPECT_EQ(scale(Measure::Ms_omega, plant), 0.5);
  EXPECT_EQ(scale(Measure::TV2_yw, plant), 1);
  EXPECT_EQ(scale(Measure::y_max_d, plant), 12);
  EXPECT_EQ(scale(Measure::TV_uw, plant), 1.0 / 12);
  EXPECT_EQ(scale(Measure::u_max_d, plant), 1);
  EXPECT_EQ(scale(Measure::DM, plant), 2);
  EXPECT_EQ(scale(Measure::noise_gain, plant), 1.0 / 12);
  EXPECT_EQ(scale(Measure::PM, plant), 1);
  EXPECT_EQ(scale(Measure::Ms, plant), 1);
  EXPECT_EQ(scale(Measure::Mt, plant), 1);
}

TEST(Scale, IsPositiveForANegativeGain) {
  for (const Plant family : kPlants)
    for (const Measure m : all_measures())
      EXPECT_EQ(scale(m, {family, -3, 2, 1}), scale(m, {family, 3, 2, 1})) << to_string(m);
}

/// What follows draws a loop and a plant and compares transfer functions in both sets of units.
struct Pair {
  Loop loop;
  RealPlant plant;
  Complex s;  ///< real units, 1/time
};

Pair random_pair(RandomLoops& random, Plant family, Prefilter prefilter) {
  Loop loop;
  do loop = random.next();
  while (loop.family.plant != family);
  loop.family.prefilter = prefilter;
  if (prefilter != Prefilter::none) loop.setting.b = random.uniform(-2, 2);
  if (prefilter == Prefilter::full) loop.setting.c = random.uniform(-2, 2);
  const double Td = random.log_uniform(1e-3, 1e3);
  const double K = random.log_uniform(1e-3, 1e3) * (random.chance(0.5) ? 1 : -1);
  return {loop, {family, K, Td, loop.setting.tau_1 * Td}, Complex(0, random.log_uniform(1e-2, 10)) / Td};
}

template <typename Check>
void for_random_pairs(Check check) {
  RandomLoops random(3);
  for (const Plant family : kPlants)
    for (const Prefilter prefilter : kPrefilters)
      for (int i = 0; i < 50; ++i) check(random_pair(random, family, prefilter));
}

Complex plant_at(const RealPlant& plant, Complex s) {
  const Complex delayed = plant.K * std::exp(-plant.Td * s);
  switch (plant.family) {
    case Plant::dipdt:
      return delayed / (s * s);
    case Plant::ipdt:
      return delayed / s;
    case Plant::fotd:
      return delayed / (plant.T1 * s + 1.0);
    case Plant::jotd:
      break;
  }
  return kNaN;
}

/// F(s) of `Prefilter`, in whatever units the numbers have.
Complex prefilter_at(Prefilter prefilter, double Ti, double TD, double b, double c, Complex s) {
  const bool integral = std::isfinite(Ti);
  switch (prefilter) {
    case Prefilter::full:
      return (1.0 + b * s + c * s * s) / (integral ? 1.0 + Ti * s + Ti * TD * s * s : 1.0 + TD * s);
    case Prefilter::pi:
      return integral ? (1.0 + b * Ti * s) / (1.0 + Ti * s) : 1.0;
    case Prefilter::none:
      return 1;
  }
  return kNaN;
}

void expect_equal(double a, double b) {
  if (std::isinf(b)) {
    EXPECT_EQ(a, b);
  } else {
    EXPECT_NEAR(a, b, 1e-14 * std::abs(b));
  }
}

TEST(ControllerFor, IsUndoneByNormalised) {
  for_random_pairs([](const Pair& pair) {
    const Setting& s = pair.loop.setting;
    const Setting back = normalised(controller_for(pair.loop, pair.plant), pair.plant, pair.loop.family);
    expect_equal(back.kappa, s.kappa);
    expect_equal(back.tau_i, s.tau_i);
    expect_equal(back.delta, s.delta);
    expect_equal(back.tau_1, s.tau_1);
    expect_equal(back.tau_f, s.tau_f);
    expect_equal(back.b, s.b);
    expect_equal(back.c, s.c);
  });
}

TEST(ControllerFor, GivesTheSameOpenLoopInRealUnits) {
  for_random_pairs([](const Pair& pair) {
    const auto [loop, plant, s] = pair;
    const RealController real = controller_for(loop, plant);
    const auto [Kc, Ti, TD] = real.standard;
    Complex L = Kc * (1.0 + 1.0 / (Ti * s) + TD * s) * plant_at(plant, s);
    L /= std::pow(real.Tf * s + 1.0, loop.family.n);
    const Complex expected = response_at(open_loop(loop), s.imag() * plant.Td);
    EXPECT_LE(std::abs(L - expected), 1e-12 * std::abs(expected));
  });
}

TEST(ControllerFor, GivesTheSamePrefilterInRealUnits) {
  for_random_pairs([](const Pair& pair) {
    const auto [loop, plant, s] = pair;
    const RealController real = controller_for(loop, plant);
    const Setting& n = loop.setting;
    const Prefilter prefilter = loop.family.prefilter;
    const Complex F = prefilter_at(prefilter, real.standard.Ti, real.standard.TD, real.b, real.c, s);
    const Complex expected = prefilter_at(prefilter, n.tau_i, tau_d(n), n.b, n.c, s * plant.Td);
    EXPECT_LE(std::abs(F - expected), 1e-12 * std::abs(expected));
  });
}

/// y/d = P/(1 + L), u/w = C Q/(1 + L) and u/d = -L/(1 + L): steps of size one, time stretched by Td.
TEST(Scale, IsTheRatioOfRealToNormalisedResponses) {
  for_random_pairs([](const Pair& pair) {
    const auto& plant = pair.plant;
    const RealPlant normal{plant.family, 1, 1, pair.loop.setting.tau_1};
    const Complex L = response_at(open_loop(pair.loop), pair.s.imag() * plant.Td);
    const Complex real_y_d = plant_at(plant, pair.s) / (1.0 + L);
    const Complex normal_y_d = plant_at(normal, pair.s * plant.Td) / (1.0 + L);
    EXPECT_NEAR(std::abs(real_y_d / normal_y_d), scale(Measure::y_max_d, plant),
                1e-12 * scale(Measure::y_max_d, plant));
    const Complex real_u_w = L / plant_at(plant, pair.s), normal_u_w = L / plant_at(normal, pair.s * plant.Td);
    EXPECT_NEAR(std::abs(real_u_w / normal_u_w), scale(Measure::u_max_w, plant),
                1e-12 * scale(Measure::u_max_w, plant));
  });
}

}  // namespace
}  // namespace portrait
