/// The reference simulation against plain steps in real units: scaling to a real plant, and superposition.

#include "tests/oracle/step_loop.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/loop/real_plant.h"
#include "engine/reference/measure.h"
#include "tests/oracle/random.h"

namespace portrait::reference {
namespace {

using oracle::Random;
using oracle::Samples;
using oracle::StepLoop;

constexpr int kStepsPerDeadTime = 1000;
constexpr double kDeadTimes = 20;
constexpr double kTolerance = 4e-6;

/// Real plants, controllers and what they are in normalised numbers by hand: Td = 2.5, K = 3.
struct Case {
  std::string name;
  StepLoop real;
  Loop loop;
};

/// The denominator of the prefilter in real time.
void set_prefilter(StepLoop& real, Prefilter prefilter) {
  const bool integral = std::isfinite(real.Ti), derivative = real.Kd > 0;
  const double TD = real.Kd / real.Kc;
  if (prefilter == Prefilter::pi && integral) real.a1 = real.Ti, real.b *= real.Ti;
  if (prefilter != Prefilter::full) return;
  if (integral) real.a1 = real.Ti, real.a2 = real.Ti * TD;
  if (!integral && derivative) real.a1 = TD;
}

/// Kc K Td^2 = 0.2, Ti/Td = 8, Kd K Td = 0.6, Tf/Td = 0.1, b/Td = 1.6, c/Td^2 = 0.8
Case dipdt_pid(int n, Prefilter prefilter, bool weights) {
  const double b = weights ? (prefilter == Prefilter::pi ? 0.4 : 1.6) : 0, c = weights && b > 1 ? 0.8 : 0;
  StepLoop real{.plant = Plant::dipdt, .K = 3, .Td = 2.5, .Kc = 0.2 / 18.75, .Ti = 20, .Kd = 0.08};
  real.n = n, real.Tf = n > 0 ? 0.25 : 0, real.c = c * 6.25;
  real.b = prefilter == Prefilter::pi ? b : b * 2.5;
  set_prefilter(real, prefilter);
  const double tau_f = n > 0 ? 0.1 : 0;
  return {"dipdt n=" + std::to_string(n) + " " + std::string(to_string(prefilter)),
          real,
          {{Plant::dipdt, n, prefilter}, {.kappa = 0.2, .tau_i = 8, .delta = 0.6, .tau_f = tau_f, .b = b, .c = c}}};
}

/// Kc K Td = 0.5, Ti/Td = 6, Kd K = 0.3, Tf/Td = 0.2
Case ipdt_pid(int n) {
  StepLoop real{.plant = Plant::ipdt, .K = 3, .Td = 2.5, .Kc = 0.5 / 7.5, .Ti = 15, .Kd = 0.1, .Tf = 0.5, .n = n};
  set_prefilter(real, Prefilter::full);
  return {"ipdt n=" + std::to_string(n),
          real,
          {{Plant::ipdt, n, Prefilter::full}, {.kappa = 0.5, .tau_i = 6, .delta = 0.3, .tau_f = 0.2}}};
}

/// Kc K = 0.9, Ti/Td = 3.2, Kd K/Td = 0.36, T1/Td = 3, Tf/Td = 0.2
Case fotd_pid(int n) {
  StepLoop real{
      .plant = Plant::fotd, .K = 3, .Td = 2.5, .T1 = 7.5, .Kc = 0.3, .Ti = 8, .Kd = 0.3, .Tf = 0.5, .n = n};
  return {
      "fotd n=" + std::to_string(n),
      real,
      {{Plant::fotd, n, Prefilter::none}, {.kappa = 0.9, .tau_i = 3.2, .delta = 0.36, .tau_1 = 3, .tau_f = 0.2}}};
}

Case without_derivative(Plant plant) {
  StepLoop real{
      .plant = plant, .K = 3, .Td = 2.5, .T1 = 7.5, .Kc = plant == Plant::fotd ? 0.3 : 0.04, .Ti = 20, .b = 0.3};
  set_prefilter(real, Prefilter::pi);
  const double kappa = plant == Plant::fotd ? 0.9 : 0.3, tau_1 = plant == Plant::fotd ? 3 : 0;
  return {std::string(to_string(plant)) + " n=0 PI",
          real,
          {{plant, 0, Prefilter::pi}, {.kappa = kappa, .tau_i = 8, .tau_1 = tau_1, .b = 0.3}}};
}

Case dipdt_pd() {
  StepLoop real{
      .plant = Plant::dipdt, .K = 3, .Td = 2.5, .Kc = 0.08 / 18.75, .Kd = 0.06, .Tf = 0.25, .n = 1, .b = 4};
  set_prefilter(real, Prefilter::full);
  return {"dipdt PD",
          real,
          {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.08, .delta = 0.45, .tau_f = 0.1, .b = 1.6}}};
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (int n = 0; n <= 4; ++n) all.push_back(dipdt_pid(n, Prefilter::full, false));
  for (const Prefilter prefilter : {Prefilter::full, Prefilter::pi}) all.push_back(dipdt_pid(1, prefilter, true));
  all.push_back(dipdt_pid(0, Prefilter::none, false));
  for (int n = 1; n <= 4; ++n) all.push_back(ipdt_pid(n));
  for (int n = 1; n <= 4; ++n) all.push_back(fotd_pid(n));
  for (const Plant plant : {Plant::ipdt, Plant::fotd}) all.push_back(without_derivative(plant));
  all.push_back(dipdt_pd());
  return all;
}

RealPlant real_plant(const StepLoop& real) {
  return {.family = real.plant, .K = real.K, .Td = real.Td, .T1 = real.T1};
}

double largest(const std::vector<double>& x) {
  double most = 0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

void expect_relative(double found, double expected, double tolerance, const char* what) {
  EXPECT_NEAR(found, expected, tolerance * std::abs(expected)) << what;
}

TEST(StepLoop, TimeAndGainScalingOfMeasures) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const RealPlant plant = real_plant(c.real);
    const MeasureRow row = measure(c.loop, simulate(c.loop, Horizon::fixed(kDeadTimes))).measures;
    const auto real = [&](Measure m) { return row[m] * scale(m, plant); };
    const Samples w = run_step_loop(c.real, 1, 0, kDeadTimes, kStepsPerDeadTime);
    const Samples d = run_step_loop(c.real, 0, 1, kDeadTimes, kStepsPerDeadTime);
    if (!std::isnan(row[Measure::IAE_w]))
      expect_relative(sampled_error(w, 1), real(Measure::IAE_w), kTolerance, "IAE_w");
    if (!std::isnan(row[Measure::IAE_d]))
      expect_relative(sampled_error(d, 0), real(Measure::IAE_d), kTolerance, "IAE_d");
    expect_relative(oracle::sampled_variation(w.y), real(Measure::TV_yw), kTolerance, "TV_yw");
    expect_relative(oracle::sampled_variation(w.u), real(Measure::TV_uw), kTolerance, "TV_uw");
    expect_relative(oracle::sampled_variation(d.y), real(Measure::TV_yd), kTolerance, "TV_yd");
    expect_relative(oracle::sampled_variation(d.u), real(Measure::TV_ud), kTolerance, "TV_ud");
    expect_relative(largest(w.y), real(Measure::y_max_w), kTolerance, "y_max_w");
    expect_relative(largest(w.u), real(Measure::u_max_w), kTolerance, "u_max_w");
    expect_relative(largest(d.y), real(Measure::y_max_d), kTolerance, "y_max_d");
    expect_relative(largest(d.u), real(Measure::u_max_d), kTolerance, "u_max_d");
  }
}

/// Steps w and d at once in real units: y = w y_w + d g y_d, u = w u_w/g + d u_d, at every sample.
void expect_superposition(const StepLoop& real, const Loop& loop, double w, double d) {
  const Response r = simulate(loop, Horizon::fixed(kDeadTimes));
  const Samples together = run_step_loop(real, w, d, kDeadTimes, kStepsPerDeadTime);
  const double g = input_gain(real_plant(real));
  double y_error = 0, u_error = 0;
  for (std::size_t i = 0; i < together.y.size(); i += 7) {
    const double t = static_cast<double>(i) / kStepsPerDeadTime;
    const double y = w * y_at(r.steps[kSetpoint], t) + d * g * y_at(r.steps[kDisturbance], t);
    const double u = w / g * u_at(r.steps[kSetpoint], t) + d * u_at(r.steps[kDisturbance], t);
    y_error = std::max(y_error, std::abs(together.y[i] - y));
    u_error = std::max(u_error, std::abs(together.u[i] - u));
  }
  EXPECT_LE(y_error, kTolerance * largest(together.y));
  EXPECT_LE(u_error, kTolerance * largest(together.u));
}

TEST(StepLoop, BothStepsAtOnceAreTheSumOfTheTwoResponses) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    expect_superposition(c.real, c.loop, 2, -3);
  }
}

/// The way through engine/loop/real_plant.h: the real controller of a normalised loop, run on the real plant.
TEST(StepLoop, RandomRealPlantsThroughControllerFor) {
  Random random(11);
  for (int trial = 0; trial < 30; ++trial) {
    const auto family = static_cast<Plant>(random.below(3));
    const RealPlant plant{.family = family,
                          .K = random.log_uniform(0.1, 10) * (random.chance(0.3) ? -1 : 1),
                          .Td = random.log_uniform(0.1, 20),
                          .T1 = random.log_uniform(0.5, 50)};
    const Loop loop{{family, 1 + random.below(4), Prefilter::full},
                    {.kappa = random.log_uniform(0.05, 0.4),
                     .tau_i = random.log_uniform(5, 20),
                     .delta = random.log_uniform(0.1, 0.6),
                     .tau_1 = plant.T1 / plant.Td,
                     .tau_f = random.log_uniform(0.1, 0.5),
                     .b = random.uniform(0, 2),
                     .c = random.uniform(0, 2)}};
    SCOPED_TRACE(simulate_command(loop));
    const RealController real = controller_for(loop, plant);
    const double Kc = real.standard.Kc, TD = real.standard.TD, Ti = real.standard.Ti;
    const StepLoop steps{.plant = family,
                         .K = plant.K,
                         .Td = plant.Td,
                         .T1 = plant.T1,
                         .Kc = Kc,
                         .Ti = Ti,
                         .Kd = Kc * TD,
                         .Tf = real.Tf,
                         .n = loop.family.n,
                         .b = real.b,
                         .c = real.c,
                         .a1 = Ti,
                         .a2 = Ti * TD};
    expect_superposition(steps, loop, 1, 0.7);
  }
}

}  // namespace
}  // namespace portrait::reference
