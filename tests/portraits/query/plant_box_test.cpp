/// Boxes of plants: what may be one, and where a controller's patch lies.
#include "portraits/query/plant_box.h"

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"

namespace portrait {
namespace {

PlantBox dipdt_box() { return {{Plant::dipdt, 2, 0.5, 0}, {1.6, 2.4}, {0.4, 0.6}, {0, 0}}; }

TEST(PlantBox, has_corners_and_middles_in_what_varies) {
  PlantBox box = dipdt_box();
  EXPECT_EQ(box.uncertain(), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(box.corners().size(), 4u);
  EXPECT_EQ(box.at({1, 0, 0}).K, 2.4);
  EXPECT_EQ(box.at({1, 0, 0}).Td, 0.4);
  EXPECT_EQ(box.middles(1000).size(), 32u * 32u);
  box.Td = {0.5, 0.5};
  EXPECT_EQ(box.middles(1000).size(), 1000u);
  box.K = {2, 2};
  EXPECT_EQ(box.corners().size(), 1u);
  EXPECT_EQ(box.at({0, 0, 0}).K, 2);
}

TEST(PlantBox, has_plants_from_end_to_end) {
  const PlantBox box{{Plant::fotd, 2, 0.5, 1}, {0.3, 0.9}, {0.4, 0.6}, {0.7, 2.9}};
  EXPECT_NEAR(box.at({0.25, 0, 0}).K, 0.45, 1e-15);
  EXPECT_NEAR(box.at({0, 0.5, 0}).Td, 0.5, 1e-15);
  EXPECT_EQ(box.at({1, 1, 1}).K, 0.9);  // which 0.3 + (0.9 - 0.3) is not
  EXPECT_EQ(box.at({1, 1, 1}).T1, 2.9);
}

TEST(PlantBox, middles_are_those_of_equal_cells) {
  PlantBox box = dipdt_box();
  EXPECT_EQ(box.middles(4),
            (std::vector<BoxPoint>{{0.25, 0.25, 0}, {0.25, 0.75, 0}, {0.75, 0.25, 0}, {0.75, 0.75, 0}}));
  box.Td = {0.5, 0.5};
  EXPECT_EQ(box.middles(2), (std::vector<BoxPoint>{{0.25, 0, 0}, {0.75, 0, 0}}));
  box = dipdt_box();
  box.K = {2, 2};
  EXPECT_EQ(box.middles(2), (std::vector<BoxPoint>{{0, 0.25, 0}, {0, 0.75, 0}}));
  box.Td = {0.5, 0.5};
  EXPECT_EQ(box.middles(1000), (std::vector<BoxPoint>{{0, 0, 0}}));
}

std::string why(const PlantBox& box) { return why_invalid(box).value_or("valid"); }

TEST(PlantBox, says_why_it_cannot_be) {
  PlantBox box = dipdt_box();
  EXPECT_EQ(why(box), "valid");
  box.K = {-2.4, -1.6};
  EXPECT_EQ(why(box), "the nominal K = 2 lies outside -2.4..-1.6");
  box.nominal.K = -2;
  EXPECT_EQ(why(box), "valid");
  box.K = {-2.4, 0};
  EXPECT_EQ(why(box), "K=-2.4..0 holds 0: no controller serves a gain that may vanish or change its sign");
  box = dipdt_box();
  box.Td = {0.6, 0.4};
  EXPECT_EQ(why(box), "Td=0.6..0.4: the low end comes first");
  box.Td = {0, 1};
  EXPECT_EQ(why(box), "Td must be finite and above 0 (it is 0)");
  box.Td = {0.4, kInf};
  EXPECT_EQ(why(box), "Td must be finite and above 0 (it is inf)");
  box.Td = {0.4, kNaN};
  EXPECT_EQ(why(box), "Td=0.4..nan: the low end comes first");
}

TEST(PlantBox, one_controller_has_the_settings_of_its_patch) {
  Grid grid;
  grid.family = {Plant::dipdt, 1, Prefilter::full};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.3, 11), Axis::linear(Parameter::delta, 0.3, 0.9, 7)};
  grid.fixed = {{Parameter::tau_i, 8}, {Parameter::tau_f, 0.1}, {Parameter::b, 0}, {Parameter::c, 0}};
  const Setting s{.kappa = 0.2, .tau_i = 8, .delta = 0.6, .tau_f = 0.1};
  const PlantBox box = dipdt_box();
  // Kc = 0.2/(2 * 0.25) = 0.4, Ti = 4, Kd = 0.6/(2 * 0.5) = 0.6, Tf = 0.05
  const Setting seen = seen_by({Plant::dipdt, 2.4, 0.4, 0}, {grid.family, s}, box.nominal);
  EXPECT_NEAR(seen.kappa, 0.4 * 2.4 * 0.16, 1e-15);
  EXPECT_NEAR(seen.tau_i, 10, 1e-14);
  EXPECT_NEAR(seen.delta, 0.6 * 2.4 * 0.4, 1e-15);
  EXPECT_NEAR(seen.tau_f, 0.125, 1e-15);
  const std::vector<Extent> patch = patch_of(grid, box, s);
  ASSERT_EQ(patch.size(), 5u);
  EXPECT_EQ(patch[0].parameter, Parameter::kappa);
  EXPECT_NEAR(patch[0].low, 0.4 * 1.6 * 0.16, 1e-15);
  EXPECT_NEAR(patch[0].high, 0.4 * 2.4 * 0.36, 1e-15);
  EXPECT_TRUE(patch[0].leaves_grid);  // 0.3456
  EXPECT_EQ(patch[2].parameter, Parameter::delta);
  EXPECT_FALSE(patch[2].leaves_grid);  // 0.384 .. 0.864
  EXPECT_TRUE(patch[4].leaves_grid);   // tau_f is one value
}

}  // namespace
}  // namespace portrait
