/// The functions that a robust answer keeps below their limits, by their definitions: constraints whose sides are known, and
/// loops measured by themselves.
#include "portraits/query/plant_trials.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/noise_gain.h"
#include "engine/loop/real_plant.h"
#include "portraits/query/measured.h"
#include "tests/portraits/query/ipdt_over_kappa.h"

namespace portrait {
namespace {

Grid ipdt() { return ipdt_over_kappa(80, {Measure::IAE_d, Measure::Ms, Measure::noise_gain}); }
PlantBox box() { return {{Plant::ipdt, 2, 0.5, 0}, {1.6, 2.4}, {0.4, 0.6}, {0, 0}}; }

/// What one trial comes to, by function.
std::vector<double> values_of(const std::string& objective, const std::vector<std::string>& where,
                              const Setting& setting, const RealPlant& plant = box().nominal, Grid grid = ipdt(),
                              Conditions conditions = {}) {
  const PlantBox b = box();
  const Expression minimize = parse_expression({"", objective});
  for (const std::string& text : where) conditions.where.push_back(parse_constraint({"", text}));
  conditions.units.plant = b.nominal;
  const PlantTrials trials(grid, b, minimize, conditions);
  const PlantTrials::Trial trial{setting, plant};
  return trials.values(std::span(&trial, 1), 1);
}

double excess_of(const std::string& constraint) { return values_of("1", {constraint}, with_kappa(0.4)).at(3); }

TEST(PlantTrials, a_constraint_is_its_excess_relative_to_the_right_side) {
  EXPECT_NEAR(excess_of("3*Ms/Ms <= 2"), 0.5, 1e-14);
  EXPECT_NEAR(excess_of("3*Ms/Ms >= 2"), -0.5, 1e-14);
  EXPECT_NEAR(excess_of("2*Ms/Ms >= 4"), 0.5, 1e-14);
  EXPECT_NEAR(excess_of("2*Ms/Ms <= -4"), 1.5, 1e-14);
  EXPECT_EQ(excess_of("-9*Ms/Ms <= 2"), kDeepest);
  EXPECT_EQ(excess_of("Ms <= Ms"), 0);
  EXPECT_EQ(excess_of("Ms >= Ms"), 0);
  EXPECT_GT(excess_of("Ms < Ms"), 0);
  EXPECT_GT(excess_of("Ms > Ms"), 0);
  EXPECT_LT(excess_of("Ms < Ms + 1e-9"), 0);
}

TEST(PlantTrials, a_constraint_with_infinite_or_missing_sides_holds_or_is_broken_for_good) {
  EXPECT_EQ(excess_of("inf*Ms <= 2"), kInf);
  EXPECT_EQ(excess_of("inf*Ms >= 2"), kDeepest);
  EXPECT_EQ(excess_of("Ms <= inf*Ms"), kDeepest);
  EXPECT_EQ(excess_of("Ms >= inf*Ms"), kInf);
  EXPECT_EQ(excess_of("inf*Ms <= inf*Ms"), 0);
  EXPECT_EQ(excess_of("log(-Ms) <= 2"), kInf);
}

TEST(PlantTrials, a_relation_between_names_of_the_grid_is_never_broken) {
  EXPECT_EQ(excess_of("kappa <= 0.1"), kDeepest);
  EXPECT_EQ(excess_of("Kc >= 100"), kDeepest);
  EXPECT_GT(excess_of("kappa + 0*Ms <= 0.1"), 0);
}

TEST(PlantTrials, measures_are_those_of_the_real_loop_on_its_plant) {
  const RealPlant other{Plant::ipdt, 2.4, 0.6, 0};
  const Setting setting = with_kappa(0.4);
  const Setting there = normalised(controller_for({ipdt().family, setting}, box().nominal), other, ipdt().family);
  const Measured seen = measure(ipdt(), {}, std::span(&there, 1), 1).front();
  Conditions conditions;
  conditions.units.steps.d = 3;
  const auto values = values_of("IAE_d", {"kappa + 0*Ms <= 0.2"}, setting, other, ipdt(), conditions);
  EXPECT_NEAR(values[0], 3 * scale(Measure::IAE_d, other) * seen.measures[Measure::IAE_d], 1e-12 * values[0]);
  EXPECT_NEAR(values[1], -1 / seen.measures[Measure::Ms], 1e-12);
  EXPECT_EQ(values[2], -1);
  EXPECT_NEAR(values[3], 1, 1e-14);  // kappa is that of the nominal plant
}

TEST(PlantTrials, an_unstable_loop_breaks_everything) {
  const auto values = values_of("IAE_d", {"Ms <= 1e9"}, with_kappa(1), {Plant::ipdt, 9, 0.5, 0});
  EXPECT_EQ(values[0], kInf);
  EXPECT_EQ(values[1], kInf);
  EXPECT_EQ(values[2], 1);
  EXPECT_EQ(values[3], kInf);
}

TEST(PlantTrials, a_loop_that_has_not_settled_counts_when_asked_for) {
  Grid soon = ipdt();
  soon.horizon = Horizon::fixed(4);
  Conditions conditions;
  EXPECT_EQ(values_of("1", {}, with_kappa(0.4), box().nominal, soon, conditions).at(2), 1);
  conditions.include_not_settled = true;
  EXPECT_EQ(values_of("1", {}, with_kappa(0.4), box().nominal, soon, conditions).at(2), -1);
  EXPECT_EQ(values_of("1", {}, with_kappa(1), {Plant::ipdt, 9, 0.5, 0}, soon, conditions).at(2), 1);
}

TEST(PlantTrials, the_sampling_of_the_noise_gain_is_the_same_time_on_every_plant) {
  Grid sampled = ipdt();
  sampled.sampling = 0.02;  // 0.01 in real time
  const RealPlant slow{Plant::ipdt, 1, 2, 0};
  const Setting setting = with_kappa(0.4);
  const Setting there = normalised(controller_for({sampled.family, setting}, box().nominal), slow, sampled.family);
  const double expected = noise_gain({sampled.family, there}, 0.005) * scale(Measure::noise_gain, slow);
  EXPECT_NEAR(values_of("noise_gain", {}, setting, slow, sampled).at(0), expected, 1e-12 * expected);
}

TEST(PlantTrials, limits_are_those_of_a_stable_settled_loop) {
  const PlantBox b = box();
  const Grid grid = ipdt();
  const Expression objective = parse_expression({"", "IAE_d"});
  Conditions conditions;
  conditions.where = {parse_constraint({"", "Ms <= 2"})};
  const PlantTrials trials(grid, b, objective, conditions);
  ASSERT_EQ(trials.limits().size(), trials.functions());
  EXPECT_TRUE(std::isfinite(trials.limits()[kObjective]));
  EXPECT_LT(trials.limits()[kStability], 0);
  EXPECT_EQ(trials.limits()[kStatus], 0);
  EXPECT_EQ(trials.limits()[kFirstConstraint], 0);
  const PlantTrials::Report report = trials.report({with_kappa(0.4), b.nominal});
  EXPECT_EQ(report.left.at(0), report.Ms);
  EXPECT_EQ(report.right.at(0), 2);
  EXPECT_EQ(report.objective, report.measured.measures[Measure::IAE_d]);
}

TEST(PlantTrials, many_give_what_each_gives_alone) {
  const PlantBox b = box();
  const Grid grid = ipdt();
  const Expression objective = parse_expression({"", "IAE_d"});
  Conditions conditions;
  conditions.where = {parse_constraint({"", "Ms <= 2"}), parse_constraint({"", "IAE_d >= 3"})};
  const PlantTrials trials(grid, b, objective, conditions);
  std::vector<PlantTrials::Trial> all;
  for (const double kappa : {0.3, 0.4, 0.5})
    for (const BoxPoint& corner : b.corners()) all.push_back({with_kappa(kappa), b.at(corner)});
  const std::vector<double> together = trials.values(all, 1);
  ASSERT_EQ(together.size(), all.size() * trials.functions());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<double> alone = trials.values(std::span(&all[i], 1), 1);
    for (std::size_t f = 0; f < alone.size(); ++f) EXPECT_EQ(together[i * trials.functions() + f], alone[f]);
  }
}

}  // namespace
}  // namespace portrait
