/// Refined optima against published ones, a dense scan, and their own prices.
#include "portraits/query/refine.h"

#include <gtest/gtest.h>

#include "portraits/query/region.h"

namespace portrait {
namespace {

Conditions conditions(const std::vector<std::string>& where) {
  Conditions all;
  for (const std::string& text : where) all.where.push_back(parse_constraint({"--where", text}));
  return all;
}

Expression expression(const std::string& text) { return parse_expression({"--minimize", text}); }

/// Dalen2018: PI on an integrator with dead time, output step and input step alike.
Grid dalen() {
  Grid grid;
  grid.family = {Plant::ipdt, 0, Prefilter::none};
  grid.horizon = Horizon::until_settled();
  grid.measures = {Measure::IAE_w, Measure::IAE_d, Measure::Ms};
  grid.axes = {Axis::linear(Parameter::kappa, 0.2, 0.8, 13), Axis::linear(Parameter::tau_i, 3, 20, 18)};
  grid.fixed = {{Parameter::delta, 0}};
  return grid;
}

/// Ms = 1.59 is active, so that least J under Ms <= 1.59 is least J at Ms = 1.59.
TEST(Refine, finds_the_pareto_optimal_settings_of_Dalen2018) {
  const Grid grid = dalen();
  const Conditions at = conditions({"Ms <= 1.59"});
  const Setting from{.kappa = 0.35, .tau_i = 8};
  // (41) with s_r = 0.5; printed 0.41, 6.28, J = 1.52 by simulation in steps of 0.1: 1 % above the true least.
  // References 2.17 and 15.10 printed.
  const Refined both = refine(grid, expression("0.5*IAE_w/2.1692 + 0.5*IAE_d/15.0942"), at, from);
  EXPECT_TRUE(both.converged);
  EXPECT_NEAR(both.best.setting.kappa, 0.41, 0.005);
  EXPECT_NEAR(both.best.setting.tau_i, 6.28, 0.01);
  EXPECT_NEAR(both.objective, 1.5055, 1e-4);
  EXPECT_LE(both.left[0], 1.59);
  EXPECT_NEAR(both.left[0], 1.59, 1e-8);
  // Least IAE_d at Ms = 1.59; the paper's reference is 15.10 at 0.4, 5.8.
  const Refined regulator = refine(grid, expression("IAE_d"), at, from);
  EXPECT_NEAR(regulator.best.setting.kappa, 0.4, 0.005);
  EXPECT_NEAR(regulator.best.setting.tau_i, 5.8, 0.02);
  EXPECT_NEAR(regulator.objective, 15.0942, 1e-3);
}

/// The curve Ms = 1.59 walked through in small steps, by bisection of kappa.
TEST(Refine, is_the_least_of_a_dense_scan_to_1e_6) {
  const Grid grid = dalen();
  const Refined refined =
      refine(grid, expression("IAE_d"), conditions({"Ms <= 1.59"}), {.kappa = 0.35, .tau_i = 8});
  double least = kInf;
  for (double tau_i = 5.77; tau_i <= 5.8; tau_i += 0.001) {
    double low = 0.2, high = 0.6;
    for (int i = 0; i < 50; ++i) {
      const Setting middle{.kappa = 0.5 * (low + high), .tau_i = tau_i};
      const double Ms = measure(grid, {}, std::span(&middle, 1)).front().measures[Measure::Ms];
      (Ms <= 1.59 ? low : high) = middle.kappa;
    }
    const Setting at{.kappa = low, .tau_i = tau_i};
    least = std::min(least, measure(grid, {}, std::span(&at, 1)).front().measures[Measure::IAE_d]);
  }
  EXPECT_LE(refined.objective, least * (1 + 1e-9));
  EXPECT_NEAR(refined.objective / least, 1, 1e-6);
}

TEST(Refine, a_price_is_what_a_looser_bound_gains) {
  const Grid grid = dalen();
  const Setting from{.kappa = 0.35, .tau_i = 8};
  const Refined tight = refine(grid, expression("IAE_d"), conditions({"Ms <= 1.59"}), from);
  const Refined loose = refine(grid, expression("IAE_d"), conditions({"Ms <= 1.591"}), from);
  EXPECT_NEAR(tight.prices[0], (tight.objective - loose.objective) / 0.001, 0.01 * tight.prices[0]);
}

/// Huba2022 (43), (46).
Grid huba() {
  Grid grid;
  grid.family = {Plant::dipdt, 0, Prefilter::pi};
  grid.horizon = Horizon::fixed(80);
  grid.measures = {Measure::IAE_w,  Measure::IAE_d,  Measure::TV0_yw,
                   Measure::TV2_uw, Measure::TV1_yd, Measure::TV2_ud};
  grid.axes = {Axis::linear(Parameter::kappa, 0.05, 0.35, 31), Axis::linear(Parameter::delta, 0.35, 1.05, 15),
               Axis::linear(Parameter::tau_i, 6, 22, 9)};
  grid.fixed = {{Parameter::b, 0}};
  return grid;
}

/// (47) is 41.33, (48) is 188.95: both leave much between the points of the grid.
TEST(Refine, shows_what_the_grid_of_Huba2022_leaves) {
  std::vector<std::string> where = {"TV2_uw <= 0.1", "TV2_ud <= 0.1", "TV0_yw <= 0.01", "TV1_yd <= 0.01"};
  const Expression objective = expression("IAE_w + IAE_d");
  const Setting s47{.kappa = 0.24, .tau_i = 8, .delta = 0.70}, s48{.kappa = 0.08, .tau_i = 14, .delta = 0.35};
  const Refined free = refine(huba(), objective, conditions(where), s47);
  EXPECT_NEAR(free.start_objective, 41.333, 1e-3);
  EXPECT_NEAR(free.objective, 33.774, 0.05);
  EXPECT_NEAR(free.gain(), 0.183, 0.002);
  EXPECT_TRUE(judge(huba(), conditions(where), free.best.setting).admissible());
  where.emplace_back("delta == 0.35");
  const Refined held = refine(huba(), objective, conditions(where), s48);
  EXPECT_NEAR(held.start_objective, 188.95, 0.01);
  EXPECT_EQ(held.best.setting.delta, 0.35);
  EXPECT_NEAR(held.objective, 174.09, 0.2);
  EXPECT_NEAR(held.gain(), 0.079, 0.002);
  EXPECT_TRUE(judge(huba(), conditions(where), held.best.setting).admissible());
}

TEST(Refine, warns_of_edges) {
  EXPECT_EQ(edges_at(huba(), {.kappa = 0.05, .tau_i = 8, .delta = 1.05}),
            (std::vector{Parameter::kappa, Parameter::delta}));
  EXPECT_TRUE(edges_at(huba(), {.kappa = 0.1, .tau_i = 8, .delta = 0.5}).empty());
  const Refined refined =
      refine(dalen(), expression("tau_i"), conditions({"Ms <= 5"}), {.kappa = 0.35, .tau_i = 8});
  EXPECT_EQ(refined.at_edge, std::vector{Parameter::tau_i});
}

/// PI on an integrator, or PID where tau_d is given.
Grid one_axis(Axis axis, std::vector<FixedParameter> fixed) {
  Grid grid = dalen();
  grid.axes = {std::move(axis)};
  grid.fixed = std::move(fixed);
  return grid;
}

TEST(Refine, an_axis_that_ends_at_inf_ends_at_its_last_number) {
  const Grid grid =
      one_axis(Axis::list(Parameter::tau_i, {4, 8, 20, kInf}), {{Parameter::kappa, 0.3}, {Parameter::delta, 0}});
  const Refined far = refine(grid, expression("-tau_i"), {}, {.kappa = 0.3, .tau_i = 8});
  EXPECT_EQ(far.best.setting.tau_i, 20);
  EXPECT_EQ(far.at_edge, std::vector{Parameter::tau_i});
  const Refined stays = refine(grid, expression("-tau_i"), {}, {.kappa = 0.3, .tau_i = kInf});
  EXPECT_EQ(stays.best.setting.tau_i, kInf);
  EXPECT_TRUE(stays.moved.empty());
  EXPECT_TRUE(stays.converged);
}

TEST(Refine, an_axis_tau_d_goes_from_end_to_end) {
  const Grid grid =
      one_axis(Axis::linear(Parameter::tau_d, 0.1, 0.5, 5), {{Parameter::kappa, 0.4}, {Parameter::tau_i, 8}});
  Setting from{.kappa = 0.4, .tau_i = 8};
  set(from, Parameter::tau_d, 0.4);
  for (const auto& [objective, end] : {std::pair{"tau_d", 0.1}, {"-tau_d", 0.5}}) {
    const Refined refined = refine(grid, expression(objective), {}, from);
    EXPECT_NEAR(tau_d(refined.best.setting), end, 1e-9);
    EXPECT_EQ(refined.at_edge, std::vector{Parameter::tau_d});
  }
}

TEST(Refine, a_given_tau_d_stays_when_kappa_moves) {
  const Grid grid =
      one_axis(Axis::linear(Parameter::kappa, 0.2, 0.6, 5), {{Parameter::tau_d, 0.25}, {Parameter::tau_i, 8}});
  Setting from{.kappa = 0.4, .tau_i = 8};
  set(from, Parameter::tau_d, 0.25);
  const Refined refined = refine(grid, expression("kappa"), {}, from);
  EXPECT_NEAR(refined.best.setting.kappa, 0.2, 1e-9);
  EXPECT_DOUBLE_EQ(tau_d(refined.best.setting), 0.25);
}

TEST(Refine, begins_on_a_bound) {
  const Refined refined = refine(dalen(), expression("IAE_d"), conditions({"kappa <= 0.35", "tau_i >= 8"}),
                                 {.kappa = 0.35, .tau_i = 8});
  EXPECT_EQ(refined.best.setting.kappa, 0.35);
  EXPECT_EQ(refined.best.setting.tau_i, 8);
}

}  // namespace
}  // namespace portrait
