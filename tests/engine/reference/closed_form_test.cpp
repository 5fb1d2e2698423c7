/// The reference simulation against the exact responses of tests/oracle/method_of_steps.h.

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "engine/reference/response.h"
#include "tests/oracle/method_of_steps.h"
#include "tests/oracle/random.h"

namespace portrait::reference {
namespace {

using oracle::MethodOfSteps;
using oracle::Random;
using oracle::Real;

/// At 37 instants a dead time, and at its left edge; `tolerance` of the signal's largest value, at least of 1.
void expect_signal(const oracle::Signal& exact, double (*at)(const StepResponse&, double),
                   const StepResponse& found, int dead_times, double tolerance) {
  double largest = 1, worst = 0, where = 0;
  for (int i = 0; i < 37 * dead_times; ++i) {
    const double t = i / 37.0;
    const auto expected = static_cast<double>(oracle::at(exact, t));
    largest = std::max(largest, std::abs(expected));
    const double error = std::abs(at(found, t) - expected);
    if (!(error <= worst)) worst = error, where = t;
  }
  EXPECT_LE(worst, tolerance * largest) << "at t = " << where;
}

void expect_responses(const Loop& loop, int pieces, int dead_times, double tolerance) {
  SCOPED_TRACE(simulate_command(loop));
  const Response found = simulate(loop, Horizon::fixed(dead_times));
  for (const Step step : kUsualSteps) {
    MethodOfSteps exact(loop, step == kSetpoint ? 1 : 0, step == kDisturbance ? 1 : 0, pieces);
    exact.run_to(dead_times);
    const StepResponse& response = found.steps[static_cast<std::size_t>(step)];
    expect_signal(exact.y(), y_at, response, dead_times, tolerance);
    expect_signal(exact.u(), u_at, response, dead_times, tolerance);
  }
}

Setting controller(const std::string& kind, double kappa, double tau_i, double delta) {
  const bool integral = kind == "PI" || kind == "PID", derivative = kind == "PD" || kind == "PID";
  return {.kappa = kappa, .tau_i = integral ? tau_i : kInf, .delta = derivative ? delta : 0};
}

class Polynomials : public testing::TestWithParam<const char*> {};

TEST_P(Polynomials, OfDipdt) {
  const Setting s = controller(GetParam(), 0.2, 7, 0.6);
  expect_responses({{Plant::dipdt, 0, Prefilter::none}, s}, 1, 10, 1e-12);
  expect_responses({{Plant::dipdt, 0, Prefilter::pi}, s}, 1, 10, 1e-12);
}

TEST_P(Polynomials, OfIpdtWhichAreNeutralWithADerivative) {
  const Setting s = controller(GetParam(), 0.5, 5, 0.3);
  expect_responses({{Plant::ipdt, 0, Prefilter::none}, s}, 1, 10, 1e-12);
  expect_responses({{Plant::ipdt, 0, Prefilter::pi}, s}, 1, 10, 1e-12);
}

TEST_P(Polynomials, OfLoopsThatRunAway) {
  const Setting s = controller(GetParam(), 3, 2, 2);
  expect_responses({{Plant::dipdt, 0, Prefilter::none}, s}, 1, 8, 1e-12);
  expect_responses({{Plant::ipdt, 0, Prefilter::none}, s}, 1, 8, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(ClosedForm, Polynomials, testing::Values("P", "PI", "PD", "PID"),
                         [](const auto& name) { return std::string(name.param); });

/// Any family, any numbers, stable or not. Pieces of at most four of the shortest time constant, for the power series.
struct AnyLoop {
  Loop loop;
  int pieces;
};

AnyLoop any_loop(Random& random, int n) {
  const auto plant = static_cast<Plant>(random.below(3));
  Setting s{.kappa = random.log_uniform(0.05, 1),
            .tau_i = random.chance(0.2) ? kInf : random.log_uniform(1, 30),
            .delta = random.chance(0.2) ? 0 : random.log_uniform(0.05, 0.9)};
  double shortest = s.tau_i;
  if (n > 0) shortest = std::min(shortest, s.tau_f = random.log_uniform(0.02, 1));
  if (plant == Plant::fotd) shortest = std::min(shortest, s.tau_1 = random.log_uniform(0.05, 20));
  const auto prefilter = static_cast<Prefilter>(random.below(3));
  const bool integral = has_integral_action(s), derivative = s.delta > 0;
  if (prefilter == Prefilter::pi && integral) s.b = random.uniform(0, 1);
  if (prefilter == Prefilter::full && (integral || derivative)) s.b = random.uniform(0, 3);
  if (prefilter == Prefilter::full && integral && derivative) s.c = random.uniform(0, 2);
  if (derivative) shortest = std::min(shortest, tau_d(s));
  return {{{plant, n, prefilter}, s}, 1 + static_cast<int>(1 / (4 * shortest))};
}

class Exponentials : public testing::TestWithParam<int> {};

TEST_P(Exponentials, OfRandomLoopsOfEveryFamily) {
  Random random(static_cast<std::uint64_t>(100 + GetParam()));
  for (int trial = 0; trial < 60; ++trial) {
    const AnyLoop any = any_loop(random, GetParam());
    expect_responses(any.loop, any.pieces, 8, 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(ClosedForm, Exponentials, testing::Values(0, 1, 2, 3, 4),
                         [](const auto& n) { return "n" + std::to_string(n.param); });

}  // namespace
}  // namespace portrait::reference
