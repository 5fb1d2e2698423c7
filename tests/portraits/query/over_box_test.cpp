/// What is reported of one controller over a box of plants, against plain loops over plants.
#include "portraits/query/over_box.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/real_plant.h"
#include "portraits/query/measured.h"
#include "portraits/query/robust.h"

namespace portrait {
namespace {

Grid fotd() {
  Grid grid;
  grid.family = {Plant::fotd, 0, Prefilter::none};
  grid.horizon = Horizon::fixed(60);
  grid.measures = {Measure::IAE_d, Measure::TV0_yw, Measure::Ms};
  grid.axes = {Axis::list(Parameter::tau_1, {2, 3})};
  grid.fixed = {{Parameter::kappa, 1}, {Parameter::tau_i, 3}, {Parameter::delta, 0}};
  return grid;
}

PlantBox box(double T1_low = 1.2, double T1_high = 1.8) {
  return {{Plant::fotd, 2, 0.5, 1.5}, {1.7, 2.6}, {0.4, 0.7}, {T1_low, T1_high}};
}

Setting setting(double kappa) { return {.kappa = kappa, .tau_i = 3, .delta = 0, .tau_1 = 3}; }

RobustQuestion asked(const PlantBox& box, const std::vector<std::string>& where) {
  RobustQuestion question{.minimize = parse_expression({"", "IAE_d"}), .conditions = {}, .box = box};
  for (const std::string& text : where) question.conditions.where.push_back(parse_constraint({"", text}));
  question.conditions.units.plant = box.nominal;
  return question;
}

/// Measures of the controller on every plant of a lattice of midpoints, in real units.
std::vector<Measured> on_midpoints(const PlantBox& box, const Setting& setting, int each) {
  std::vector<RealPlant> plants;
  std::vector<Setting> seen;
  const auto at = [&](int i) { return (i + 0.5) / each; };
  for (int i = 0; i < each; ++i)
    for (int j = 0; j < each; ++j)
      for (int k = 0; k < each; ++k) {
        const auto in = [](const Range& range, double part) { return range.low + part * (range.high - range.low); };
        plants.push_back({Plant::fotd, in(box.K, at(i)), in(box.Td, at(j)), in(box.T1, at(k))});
        seen.push_back(
            normalised(controller_for({fotd().family, setting}, box.nominal), plants.back(), fotd().family));
      }
  std::vector<Measured> all = measure(fotd(), {}, seen, 1);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (const Measure m : fotd().measures) all[i].measures[m] *= scale(m, plants[i]);
  return all;
}

double share_of(const std::vector<Measured>& all, const std::function<bool(const Measured&)>& breaks) {
  return static_cast<double>(std::count_if(all.begin(), all.end(), breaks)) / static_cast<double>(all.size());
}

TEST(OverBox, shares_are_those_of_a_thousand_plants_spread_evenly) {
  const auto over = examine(fotd(), asked(box(), {"Ms <= 1.8", "TV0_yw <= 0.2"}), setting(1.2));
  const std::vector<Measured> all = on_midpoints(box(), setting(1.2), 10);
  const auto sensitive = [](const Measured& m) { return m.measures[Measure::Ms] > 1.8; };
  const auto swings = [](const Measured& m) { return m.measures[Measure::TV0_yw] > 0.2; };
  EXPECT_EQ(over.outcome, Outcome::beyond);
  EXPECT_EQ(over.constraints.at(0).share, share_of(all, sensitive));
  EXPECT_EQ(over.constraints.at(1).share, share_of(all, swings));
  EXPECT_EQ(over.share, share_of(all, [&](const Measured& m) { return sensitive(m) || swings(m); }));
  for (const WorstPlant& worst : over.constraints) {
    EXPECT_GT(worst.share, 0.02);
    EXPECT_LT(worst.share, 0.98);
  }
  EXPECT_TRUE(over.right_status);
  EXPECT_EQ(over.share_wrong_status, 0);
}

TEST(OverBox, the_mean_is_over_all_plants_alike) {
  const auto over = examine(fotd(), asked(box(), {}), setting(0.9));
  double sum = 0, greatest = 0, Ms = 0;
  const std::vector<Measured> all = on_midpoints(box(), setting(0.9), 16);
  for (const Measured& one : all) {
    sum += one.measures[Measure::IAE_d];
    greatest = std::max(greatest, one.measures[Measure::IAE_d]);
    Ms = std::max(Ms, one.measures[Measure::Ms]);
  }
  const double mean = sum / static_cast<double>(all.size());
  EXPECT_NEAR(over.objective_mean, mean, 1e-3 * mean);
  EXPECT_GE(over.objective.left, greatest);
  EXPECT_LE(over.objective.left, 1.1 * greatest);
  EXPECT_GE(over.Ms, Ms);
  EXPECT_LE(over.Ms, 1.1 * Ms);
  EXPECT_EQ(over.outcome, Outcome::within);
  EXPECT_EQ(over.share, 0);
}

/// The worst plants, and how far they are off, by the corners: everything here grows towards one of them.
TEST(OverBox, the_worst_plant_is_where_the_measure_says) {
  const PlantBox b = box();
  const auto over = examine(fotd(), asked(b, {"Ms <= 1.5"}), setting(0.9));
  const WorstPlant& worst = over.constraints.at(0);
  EXPECT_EQ(worst.plant.K, b.K.high);
  EXPECT_EQ(worst.plant.Td, b.Td.high);
  EXPECT_EQ(worst.left, over.Ms);
  EXPECT_EQ(worst.right, 1.5);
  EXPECT_NEAR(worst.relative, over.Ms / 1.5 - 1, 1e-9);
  EXPECT_GE(worst.bound, worst.relative);
  EXPECT_LE(worst.bound, worst.relative + 2.1e-3);
  EXPECT_EQ(over.Ms_plant.K, worst.plant.K);
  EXPECT_EQ(over.Ms_plant.Td, worst.plant.Td);
}

TEST(OverBox, says_where_a_plant_is_unstable) {
  PlantBox wide = box();
  wide.K.high = 7;
  const auto over = examine(fotd(), asked(wide, {}), setting(1.2));
  const double unstable =
      share_of(on_midpoints(wide, setting(1.2), 10), [](const Measured& m) { return m.status != Status::settled; });
  EXPECT_EQ(over.outcome, Outcome::beyond);
  EXPECT_TRUE(std::isnan(over.Ms));
  EXPECT_FALSE(over.right_status);
  EXPECT_EQ(over.share_wrong_status, unstable);
  EXPECT_EQ(over.share, unstable);
  EXPECT_GT(unstable, 0.02);
  EXPECT_LT(unstable, 0.98);
  const RealPlant& plant = over.wrong_status_plant;
  const Setting seen =
      normalised(controller_for({fotd().family, setting(1.2)}, wide.nominal), plant, fotd().family);
  EXPECT_NE(measure(fotd(), {}, std::span(&seen, 1), 1).front().status, Status::settled);
}

}  // namespace
}  // namespace portrait
