// The common settings of two grids, against a plain search for equal settings.
#include "grids/overlap.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

bool is_same(const Setting& a, const Setting& b) {
  for (const Parameter p : {Parameter::kappa, Parameter::tau_i, Parameter::delta, Parameter::tau_f, Parameter::b, Parameter::c})
    if (get(a, p) != get(b, p)) return false;
  return true;
}

std::uint64_t number_in(const Grid& grid, const Setting& setting) {
  for (std::uint64_t number = 0; number < setting_count(grid); ++number)
    if (is_same(setting_at(grid, number), setting)) return number;
  return Overlap::kNone;
}

/// kappa, tau_i, delta, tau_f in random order, each an axis or fixed, with values that often meet those of others.
Grid random_grid(std::mt19937_64& random) {
  std::vector<Parameter> order = {Parameter::kappa, Parameter::tau_i, Parameter::delta, Parameter::tau_f};
  std::shuffle(order.begin(), order.end(), random);
  Grid grid;
  grid.family = {Plant::dipdt, 1, Prefilter::full};
  for (const Parameter parameter : order) {
    std::vector<double> values;
    for (int i = 1; i <= 6; ++i)
      if (random() % 3 != 0) values.push_back(0.1 * i);
    if (values.empty()) values.push_back(0.3);
    if (random() % 3 == 0)
      grid.fixed.push_back({parameter, values.front()});
    else
      grid.axes.push_back(random() % 4 == 0 ? Axis::linear(parameter, 0.1, 0.5, 5) : Axis::list(parameter, values));
  }
  grid.fixed.push_back({Parameter::b, 0});
  return grid;
}

TEST(Overlap, IsThatOfAPlainSearch) {
  std::mt19937_64 random(1);
  int shared = 0, apart = 0;
  for (int i = 0; i < 300; ++i) {
    const Grid grid = random_grid(random), other = random_grid(random);
    const Overlap overlap(grid, other);
    // A box somewhere in the grid: its last axis cut, the others single values or whole.
    Box box;
    for (const Axis& axis : grid.axes) {
      box.start.push_back(random() % axis.size());
      box.extent.push_back(1 + random() % (axis.size() - box.start.back()));
    }
    const std::vector<std::uint64_t> numbers = overlap.numbers_in(box);
    const std::vector<Setting> settings = settings_in(grid, box);
    ASSERT_EQ(numbers.size(), settings.size());
    std::uint64_t count = 0, all = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      ASSERT_EQ(numbers[k], number_in(other, settings[k]));
      count += numbers[k] != Overlap::kNone ? 1 : 0;
    }
    for (std::uint64_t n = 0; n < setting_count(grid); ++n)
      all += number_in(other, setting_at(grid, n)) != Overlap::kNone ? 1 : 0;
    EXPECT_EQ(overlap.size_in(box), count);
    EXPECT_EQ(overlap.size(), all);
    EXPECT_EQ(overlap.apart().has_value(), all == 0);
    (all == 0 ? apart : shared) += 1;
  }
  EXPECT_GT(shared, 100);
  EXPECT_GT(apart, 20);
}

TEST(Overlap, ValuesOfALinearAxisMeetTheSameNumbersWritten) {
  const Overlap overlap(parsed(kExample), parsed("plant = \"dipdt\"\nn = 1\nhorizon = 51\n[parameters]\nkappa = 0.24\n"
                                                 "delta = [0.5, 0.7]\ntau_i = inf\ntau_f = 0.1\n"));
  EXPECT_EQ(overlap.size(), 2u);
}

TEST(Overlap, ADerivativeGivenInAnotherWayHasNothingInCommon) {
  Grid grid = grid_of({3, 2}), other = grid_of({3, 1});
  other.axes.back() = Axis::list(Parameter::tau_d, {1});
  EXPECT_EQ(Overlap(grid, other).apart(), Parameter::delta);
  EXPECT_EQ(Overlap(grid, other).size(), 0u);
}

/// An axis is searched, not listed: this one would fill the memory.
TEST(Overlap, AnAxisOfManyValuesCostsNothing) {
  Grid grid = grid_of({3, 2}), other = grid_of({3, 2});
  grid.axes[0] = Axis::linear(Parameter::kappa, 1, 3, 2'000'000'000'001);
  EXPECT_EQ(Overlap(grid, other).size(), 6u);
}

}  // namespace
}  // namespace portrait
