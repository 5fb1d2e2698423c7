#include "grids/grid.h"

#include <gtest/gtest.h>

#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

TEST(Grid, LastAxisIsFastest) {
  const Grid grid = grid_of({2, 3, 4});
  EXPECT_EQ(setting_count(grid), 24u);
  EXPECT_EQ(coordinates(grid, 0), (std::vector<std::uint64_t>{0, 0, 0}));
  EXPECT_EQ(coordinates(grid, 1), (std::vector<std::uint64_t>{0, 0, 1}));
  EXPECT_EQ(coordinates(grid, 4), (std::vector<std::uint64_t>{0, 1, 0}));
  EXPECT_EQ(coordinates(grid, 23), (std::vector<std::uint64_t>{1, 2, 3}));
}

TEST(Grid, SettingTakesAxesAndFixedValues) {
  const Grid grid = grid_of({2, 3, 4});
  const Setting setting = setting_at(grid, 23);
  EXPECT_EQ(setting.kappa, 2);
  EXPECT_EQ(setting.delta, 3);
  EXPECT_EQ(setting.tau_i, 4);
  EXPECT_EQ(setting.tau_f, 1);
  EXPECT_EQ(setting.b, 0);
}

TEST(Grid, WithoutAxesItIsOneSetting) {
  const Grid grid = grid_of({});
  EXPECT_EQ(setting_count(grid), 1u);
  EXPECT_TRUE(coordinates(grid, 0).empty());
  EXPECT_EQ(setting_at(grid, 0).kappa, 1);
}

TEST(Grid, TauDIsTakenTimesKappaWhicheverStandsFirst) {
  Grid grid;
  grid.axes = {Axis::list(Parameter::tau_d, {3, 4}), Axis::list(Parameter::kappa, {0.5, 2})};
  EXPECT_EQ(setting_at(grid, 0).delta, 1.5);
  EXPECT_EQ(setting_at(grid, 3).delta, 8);
  grid.axes = {Axis::list(Parameter::kappa, {0.5, 2})};
  grid.fixed = {{Parameter::tau_d, 3}};
  EXPECT_EQ(setting_at(grid, 1).delta, 6);
}

TEST(Grid, AQuadrillionSettingsCostNothing) {
  const Grid grid = grid_of({100'000, 100'000, 100'000});
  EXPECT_EQ(setting_count(grid), 1'000'000'000'000'000u);
  const Setting last = setting_at(grid, setting_count(grid) - 1);
  EXPECT_EQ(last.kappa, 100'000);
  EXPECT_EQ(last.tau_i, 100'000);
  EXPECT_EQ(setting_at(grid, 123'456'789'012'345).delta, 67'891);  // coordinates 12345, 67890, 12345
}

}  // namespace
}  // namespace portrait
