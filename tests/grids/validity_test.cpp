#include "grids/validity.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace portrait {
namespace {

Grid grid_with(LoopFamily family, std::vector<Axis> axes) {
  Grid grid;
  grid.family = family;
  grid.axes = std::move(axes);
  return grid;
}

/// The slow way: ask for every setting.
bool has_invalid(const Grid& grid) {
  for (std::uint64_t number = 0; number < setting_count(grid); ++number)
    if (why_invalid({grid.family, setting_at(grid, number)})) return true;
  return false;
}

TEST(Validity, NamesTheCulprit) {
  const LoopFamily family{Plant::dipdt, 0, Prefilter::pi};
  const auto invalid = find_invalid(grid_with(family, {Axis::linear(Parameter::kappa, -1, 1, 2001)}));
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->culprit, Parameter::kappa);
  EXPECT_EQ(invalid->reason, "kappa must be finite and above 0 (it is -1)");
}

TEST(Validity, FindsAZeroInTheMiddleOfAHugeAxis) {
  const LoopFamily family{Plant::dipdt, 1, Prefilter::full};
  Grid grid = grid_with(family, {Axis::list(Parameter::kappa, {1}), Axis::linear(Parameter::delta, 0, 1, 1'000'001),
                                 Axis::linear(Parameter::c, -1, 1, 2'000'001), Axis::list(Parameter::tau_i, {8})});
  grid.fixed = {{Parameter::tau_f, 0.1}};
  const auto invalid = find_invalid(grid);
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->culprit, Parameter::c);
  grid.axes[1] = Axis::linear(Parameter::delta, 0.1, 1, 1'000'001);
  EXPECT_FALSE(find_invalid(grid).has_value());
}

TEST(Validity, ATauDIsBlamedForItsDelta) {
  const LoopFamily family{Plant::dipdt, 0, Prefilter::pi};
  const auto invalid =
      find_invalid(grid_with(family, {Axis::list(Parameter::kappa, {0.5}), Axis::list(Parameter::tau_d, {-1, 3})}));
  ASSERT_TRUE(invalid.has_value());
  EXPECT_EQ(invalid->culprit, Parameter::tau_d);
  EXPECT_EQ(invalid->reason, "with delta = kappa tau_d, delta must be finite and not below 0 (it is -0.5)");
}

TEST(Validity, AProductThatOverflowsOrVanishesIsFound) {
  const LoopFamily family{Plant::dipdt, 0, Prefilter::pi};
  const Axis kappa = Axis::list(Parameter::kappa, {1, 2, 1e120});
  EXPECT_FALSE(find_invalid(grid_with(family, {kappa, Axis::list(Parameter::tau_d, {1, 2})})).has_value());
  EXPECT_TRUE(find_invalid(grid_with(family, {kappa, Axis::list(Parameter::tau_d, {1, 1e200})})).has_value());
  // Neither is the only one that no double can multiply.
  const Axis far = Axis::list(Parameter::kappa, {1e150}), slow = Axis::list(Parameter::tau_f, {1e10});
  EXPECT_EQ(find_invalid(grid_with({Plant::dipdt, 15, Prefilter::none}, {far, slow}))->culprit, Parameter::kappa);

  Grid filtered = grid_with({Plant::dipdt, 1, Prefilter::full},
                            {Axis::list(Parameter::kappa, {1e-200, 1}), Axis::list(Parameter::tau_d, {1e-200, 1})});
  filtered.fixed = {{Parameter::tau_i, 8}, {Parameter::tau_f, 0.1}, {Parameter::c, 1}};
  EXPECT_TRUE(find_invalid(filtered).has_value());
}

/// A sorted choice out of values of every class, rarely an invalid one.
Axis any_axis(Parameter parameter) {
  const auto value = rc::gen::weightedElement<double>(
      {{1, -kInf}, {1, -2}, {1, -1}, {3, 0}, {20, 0.5}, {20, 1}, {20, 2}, {20, 3}, {2, kInf}});
  std::vector<double> values =
      *rc::gen::container<std::vector<double>>(*rc::gen::inRange<std::size_t>(1, 4), value);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return Axis::list(parameter, values);
}

RC_GTEST_PROP(ValidityProperty, AgreesWithAskingEverySetting, ()) {
  const LoopFamily family{*rc::gen::element(Plant::dipdt, Plant::ipdt, Plant::fotd), *rc::gen::element(0, 2),
                          *rc::gen::element(Prefilter::full, Prefilter::pi, Prefilter::none)};
  const Parameter left_out = *rc::gen::element(Parameter::delta, Parameter::tau_d);
  std::vector<Axis> axes;
  for (const Parameter parameter : parameters_of(family))
    if (parameter != left_out) axes.push_back(any_axis(parameter));
  const Grid grid = grid_with(family, axes);
  const bool invalid = has_invalid(grid);
  RC_CLASSIFY(invalid);
  RC_ASSERT(find_invalid(grid).has_value() == invalid);
}

}  // namespace
}  // namespace portrait
