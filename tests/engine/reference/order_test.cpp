/// How fast the reference simulation becomes exact when its panels shrink, with no refinement of its own.
///
/// Radau collocation with s stages is of order 2 s - 1 where panels meet and of order s + 1 between; the dead time
/// keeps both, because every kink lies where panels meet. Integrals of |e| gain the higher order too.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"

namespace portrait::reference {
namespace {

constexpr double kHorizon = 12;

/// Time constants above half a dead time: then a dead time is cut into equal panels and nothing else.
std::vector<Loop> loops() {
  return {{{Plant::dipdt, 0, Prefilter::pi}, {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045}},
          {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.6}},
          {{Plant::ipdt, 0, Prefilter::pi}, {.kappa = 0.5, .tau_i = 6, .delta = 0.3}},
          {{Plant::fotd, 2, Prefilter::full}, {.kappa = 0.9, .tau_i = 3, .delta = 0.5, .tau_1 = 2, .tau_f = 0.7}}};
}

struct Errors {
  double between = 0;    ///< largest error of y and u at many instants
  double where_met = 0;  ///< largest error of y at multiples of half a dead time
  double iae_w = 0, iae_d = 0;
};

Errors errors(const Loop& loop, const Response& exact, int stages, int panels) {
  const Response coarse = simulate(loop, Horizon::fixed(kHorizon), {stages, panels, kInf});
  EXPECT_EQ(coarse.steps[0].pieces.size(), static_cast<std::size_t>(kHorizon) * static_cast<std::size_t>(panels));
  Errors e;
  for (const Step step : kUsualSteps) {
    const StepResponse& a = coarse.steps[static_cast<std::size_t>(step)];
    const StepResponse& b = exact.steps[static_cast<std::size_t>(step)];
    for (double t = 1.013; t < kHorizon; t += 0.0171)
      e.between = std::max({e.between, std::abs(y_at(a, t) - y_at(b, t)), std::abs(u_at(a, t) - u_at(b, t))});
    for (double t = 1; t < kHorizon; t += 0.5)
      e.where_met = std::max(e.where_met, std::abs(y_at(a, t) - y_at(b, t)));
  }
  const MeasureRow found = measure(loop, coarse).measures, expected = measure(loop, exact).measures;
  e.iae_w = std::abs(found[Measure::IAE_w] - expected[Measure::IAE_w]);
  e.iae_d = std::abs(found[Measure::IAE_d] - expected[Measure::IAE_d]);
  return e;
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// Where the leading term rules and rounding does not.
void expect_orders(int stages, int panels, double where_met, double between) {
  for (const Loop& loop : loops()) {
    SCOPED_TRACE(simulate_command(loop));
    const Response exact = simulate(loop, Horizon::fixed(kHorizon));
    const Errors coarse = errors(loop, exact, stages, panels), fine = errors(loop, exact, stages, 2 * panels);
    EXPECT_NEAR(order(coarse.where_met, fine.where_met), where_met, 0.3);
    EXPECT_NEAR(order(coarse.between, fine.between), between, 0.4);
    EXPECT_GT(order(coarse.iae_d, fine.iae_d), where_met - 0.5);
  }
}

TEST(Order, OfThreeStagesIsFiveWherePanelsMeetAndFourBetween) {
  expect_orders(3, 4, 5, 4);
  expect_orders(3, 8, 5, 4);
}

TEST(Order, OfTwoStagesIsThree) {
  expect_orders(2, 8, 3, 3);
  expect_orders(2, 16, 3, 3);
}

TEST(Order, OfFourStagesIsSevenWherePanelsMeetAndFiveBetween) { expect_orders(4, 2, 7, 5); }

TEST(Order, OfTheIntegralOfErrorIsFiveWithThreeStages) {
  for (const Loop& loop : loops()) {
    SCOPED_TRACE(simulate_command(loop));
    const Response exact = simulate(loop, Horizon::fixed(kHorizon));
    Errors coarse = errors(loop, exact, 3, 2);
    for (const int panels : {4, 8}) {
      const Errors fine = errors(loop, exact, 3, panels);
      EXPECT_NEAR(order(coarse.iae_w, fine.iae_w), 5, 0.7);
      EXPECT_NEAR(order(coarse.iae_d, fine.iae_d), 5, 0.7);
      coarse = fine;
    }
  }
}

}  // namespace
}  // namespace portrait::reference
