#include "portraits/query/parameter_columns.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace portrait {
namespace {

Grid grid_of(std::vector<Axis> axes, std::vector<FixedParameter> fixed) {
  Grid grid;
  grid.family = {Plant::dipdt, 1, Prefilter::full};
  grid.axes = std::move(axes);
  grid.fixed = std::move(fixed);
  return grid;
}

const Grid kWithDelta =
    grid_of({Axis::linear(Parameter::kappa, 0.1, 0.3, 3), Axis::linear(Parameter::delta, 0.2, 0.8, 4),
             Axis::list(Parameter::tau_i, {6, kInf})},
            {{Parameter::tau_f, 0.1}, {Parameter::b, 1}, {Parameter::c, 0}});
const Grid kWithTauD =
    grid_of({Axis::linear(Parameter::tau_d, 1, 3, 5), Axis::linear(Parameter::kappa, 0.1, 0.3, 3)},
            {{Parameter::tau_i, 8}, {Parameter::tau_f, 0.1}, {Parameter::b, 1}, {Parameter::c, 0}});

void expect_same_as_settings(const Grid& grid, Parameter parameter, std::uint64_t first, std::size_t count) {
  std::vector<double> values;
  ParameterColumns(grid).read(parameter, first, count, values);
  ASSERT_EQ(values.size(), count);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_EQ(values[i], get(setting_at(grid, first + i), parameter)) << to_string(parameter) << " " << first + i;
}

TEST(ParameterColumns, are_those_of_the_settings_wherever_a_block_begins) {
  for (const Parameter parameter : parameters_of(kWithDelta.family))
    for (std::uint64_t first = 0; first < 24; ++first)
      for (const std::size_t count : {std::size_t{1}, std::size_t(24 - first)})
        expect_same_as_settings(kWithDelta, parameter, first, count);
}

TEST(ParameterColumns, compute_delta_from_tau_d) { expect_same_as_settings(kWithTauD, Parameter::delta, 0, 15); }

TEST(ParameterColumns, give_the_axis_tau_d_as_it_is) {
  std::vector<double> values;
  ParameterColumns(kWithTauD).read(Parameter::tau_d, 2, 5, values);
  EXPECT_EQ(values, (std::vector<double>{1, 1.5, 1.5, 1.5, 2}));
}

TEST(ParameterColumns, of_a_single_setting_are_its_parameters) {
  const Grid grid = grid_of({}, {{Parameter::kappa, 0.2}, {Parameter::delta, 0.5}, {Parameter::tau_i, 8}});
  std::vector<double> values;
  ParameterColumns(grid).read(Parameter::tau_d, 0, 1, values);
  EXPECT_EQ(values, std::vector<double>{2.5});
}

/// Of an axis exactly; what is computed lies between the ends of both factors.
TEST(ParameterColumns, bounds_are_those_of_their_values) {
  for (const auto& [grid, computed] :
       {std::pair{&kWithDelta, Parameter::tau_d}, std::pair{&kWithTauD, Parameter::delta}}) {
    const ParameterColumns columns(*grid);
    for (const Parameter parameter : parameters_of(grid->family))
      for (std::uint64_t first = 0; first < setting_count(*grid); ++first)
        for (std::size_t count = 1; count <= setting_count(*grid) - first; ++count) {
          std::vector<double> values;
          columns.read(parameter, first, count, values);
          const auto [low, high] = std::minmax_element(values.begin(), values.end());
          const Interval bound = columns.bound(parameter, first, count);
          ASSERT_FALSE(bound.may_be_nan);
          ASSERT_LE(bound.low, *low);
          ASSERT_GE(bound.high, *high);
          if (parameter == computed && count > 1) continue;
          ASSERT_DOUBLE_EQ(bound.low, *low) << to_string(parameter) << " " << first << ", " << count;
          ASSERT_DOUBLE_EQ(bound.high, *high) << to_string(parameter) << " " << first << ", " << count;
        }
  }
}

}  // namespace
}  // namespace portrait
