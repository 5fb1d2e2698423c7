/// Queries for a real plant.
#include <gtest/gtest.h>

#include "portraits/query/query.h"
#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/small_portraits.h"

namespace portrait {
namespace {

TEST(QueryPlant, measures_are_in_real_units_and_parameters_stay_normalised) {
  MemorySource source = five({1, 2, 3, 4, 5}, {5, 4, 3, 2, 1});
  const RealPlant plant{.family = Plant::dipdt, .K = -2, .Td = 3};
  Question asked = question("IAE_w", {"TV2_uw <= 0.2", "kappa <= 0.45"});
  EXPECT_TRUE(ask(source, asked).top.empty());  // normalised, TV2_uw is at least 1
  asked.conditions.units.plant = plant;
  const Answer answer = ask(source, asked);  // TV2_uw/18 <= 0.2 is TV2_uw <= 3.6
  ASSERT_EQ(numbers(answer), Numbers{2});
  EXPECT_EQ(answer.admissible, 2u);
  EXPECT_EQ(answer.top[0].objective, 3 * 3);
  EXPECT_EQ(answer.top[0].setting.kappa, 0.3);
  EXPECT_EQ(answer.top[0].measures[Measure::IAE_w], 9);
  EXPECT_DOUBLE_EQ(answer.top[0].measures[Measure::TV2_uw], 3.0 / 18);
  EXPECT_EQ(answer.top[0].measures[Measure::IAE_d], 30 * 18 * 3);
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.objective, 3);
}

/// kappa (3) x tau_1 (0.5, 2.5, 2.6) x delta (2)
Grid fotd_grid() {
  Grid grid;
  grid.family = {Plant::fotd, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w};
  grid.axes = {Axis::linear(Parameter::kappa, 1, 3, 3), Axis::list(Parameter::tau_1, {0.5, 2.5, 2.6}),
               Axis::list(Parameter::delta, {0, 1})};
  grid.fixed = {{Parameter::tau_i, 8}};
  return grid;
}

std::string plant_problem(const Grid& grid, const RealPlant& plant) {
  Question asked = question("IAE_w");
  asked.conditions.units.plant = plant;
  return error_text([&] { ask(MemorySource(grid), asked); });
}

TEST(QueryPlant, of_fotd_asks_the_slice_of_its_time_constant) {
  MemorySource source(fotd_grid());
  for (std::uint64_t i = 0; i < 18; ++i) source.at(Measure::IAE_w, i) = 20 - static_cast<double>(i);
  source.status(2) = Status::unstable;
  source.status(0) = Status::unstable;
  Question asked = question("IAE_w", {}, 99);
  asked.conditions.units.plant = RealPlant{.family = Plant::fotd, .K = 2, .Td = 0.3, .T1 = 0.75};
  const Answer answer = ask(source, asked);
  ASSERT_EQ(numbers(answer), (Numbers{15, 14, 9, 8, 3}));
  EXPECT_EQ(answer.total, 6u);
  EXPECT_EQ(answer.left_out.unstable, 1u);
  for (const Found& one : answer.top) EXPECT_EQ(one.setting.tau_1, 2.5);
  asked.conditions.units.plant.reset();
  EXPECT_EQ(ask(source, asked).total, 18u);
}

TEST(QueryPlant, the_slice_of_a_leading_axis_skips_the_rest) {
  Grid grid = fotd_grid();
  grid.axes = {Axis::list(Parameter::tau_1, {0.5, 2.5, 2.6}), Axis::linear(Parameter::kappa, 1, 2, kTileSettings)};
  grid.fixed = {{Parameter::tau_i, 8}, {Parameter::delta, 0}};
  const MemorySource source(grid);
  Question asked = question("IAE_w");
  asked.conditions.units.plant = RealPlant{.family = Plant::fotd, .K = 1, .Td = 2, .T1 = 5};
  ASSERT_EQ(numbers(ask(source, asked)), Numbers{kTileSettings});
  EXPECT_EQ(source.values_read(), kTileSettings + 1);
}

TEST(QueryPlant, is_refused_when_it_does_not_fit) {
  Grid fixed = fotd_grid();
  fixed.axes.erase(fixed.axes.begin() + 1);
  fixed.fixed.push_back({Parameter::tau_1, 3});
  EXPECT_EQ(plant_problem(line(5), {.family = Plant::ipdt}),
            "plant: it is ipdt, but the portrait's plant is dipdt");
  EXPECT_EQ(plant_problem(line(5), {.family = Plant::dipdt, .K = 0}),
            "plant: K must be finite and not 0 (it is 0)");
  EXPECT_EQ(plant_problem(line(5), {.family = Plant::dipdt, .K = 1, .Td = -1}),
            "plant: Td must be finite and above 0 (it is -1)");
  EXPECT_EQ(plant_problem(line(5), {.family = Plant::dipdt, .K = 1, .Td = 1, .T1 = 3}),
            "plant: T1 belongs to fotd; a dipdt plant has K and Td");
  EXPECT_EQ(plant_problem(fotd_grid(), {.family = Plant::fotd}),
            "plant: T1 is missing: a fotd plant has K, Td and T1");
  EXPECT_EQ(plant_problem(fotd_grid(), {.family = Plant::fotd, .K = 1, .Td = 1, .T1 = -3}),
            "plant: T1 must be finite and above 0 (it is -3)");
  EXPECT_EQ(plant_problem(fotd_grid(), {.family = Plant::fotd, .K = 1, .Td = 2, .T1 = 3}),
            "plant: T1/Td is 1.5, which is no value of the axis tau_1 (nearest: 0.5 and 2.5)");
  EXPECT_EQ(plant_problem(fixed, {.family = Plant::fotd, .K = 1, .Td = 2, .T1 = 3}),
            "plant: T1/Td is 1.5, but tau_1 is 3 in the whole portrait");
  EXPECT_EQ(plant_problem(fixed, {.family = Plant::fotd, .K = 1, .Td = 0.1, .T1 = 0.3}), "no InputError");
}

}  // namespace
}  // namespace portrait
