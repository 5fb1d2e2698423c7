/// Portraits of many tiles: what is known of the tiles must change how much is read, never an answer. That the answers
/// without it are right is what the property tests hold.
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "portraits/query/pareto.h"
#include "portraits/query/region.h"
#include "portraits/query/trade_off.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/small_portraits.h"

namespace portrait {
namespace {

constexpr int kCases = 40;

/// Measures that change slowly along two axes, a corner unstable, no other NaN.
MemorySource smooth_source(std::mt19937& random) {
  Grid grid = line(2);
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.9, 300), Axis::linear(Parameter::tau_i, 2, 20, 97)};
  grid.fixed = {{Parameter::delta, 0.5}};
  MemorySource source(grid);
  std::uniform_real_distribution<> unit(0, 1);
  for (const Measure measure : grid.measures) {
    const double a = 6 * unit(random), b = 6 * unit(random), c = 6 * unit(random), level = 1 + unit(random);
    for (std::uint64_t i = 0; i < setting_count(grid); ++i) {
      const double x = static_cast<double>(i / 97) / 300, y = static_cast<double>(i % 97) / 97;
      const bool unstable = x + y > 1.8;
      source.at(measure, i) = unstable ? kNaN : level + std::sin(a * x + c) * std::cos(b * y);
      if (unstable) source.status(i) = Status::unstable;
    }
  }
  return source;
}

/// The median of a measure or so, times up to two.
std::string random_bound(std::mt19937& random, const char* measure) {
  return fmt::format("{} <= {}", measure, std::uniform_real_distribution<>(0.8, 2.2)(random));
}

class Skipping : public ::testing::Test {
 protected:
  void draw() {
    knowing_ = std::make_unique<MemorySource>(smooth_source(random_));
    scanning_ = std::make_unique<MemorySource>(*knowing_);
    scanning_->know_summaries(false);
    asked_ =
        question("IAE_w", {random_bound(random_, "IAE_d"), random_bound(random_, "TV2_uw")}, 1 + random_() % 30);
    asked_.conditions.threads = static_cast<int>(1 + random_() % 3);
  }
  const Conditions& conditions() const { return asked_.conditions; }

  /// From every admissible setting, since what rules tiles out here needs no summaries.
  double least_distance(const Setting& from) const {
    Question all = question("0", {}, kMaxTop);
    all.conditions = conditions();
    const Answer answer = ask(*scanning_, all);
    double least = kInf;
    for (const Found& found : answer.top) {
      double sum = 0;
      for (const Axis& axis : scanning_->grid().axes) {
        const double apart =
            place_on(axis, get(from, axis.parameter())) - place_on(axis, get(found.setting, axis.parameter()));
        sum += apart * apart;
      }
      least = std::min(least, std::sqrt(sum));
    }
    return least;
  }

  std::mt19937 random_{11};
  std::unique_ptr<MemorySource> knowing_, scanning_;
  Question asked_ = question("IAE_w");
};

TEST_F(Skipping, changes_neither_optimum_nor_prices) {
  int priced = 0;
  for (int i = 0; i < kCases; ++i) {
    draw();
    const Answer found = ask(*knowing_, asked_), plain = ask(*scanning_, asked_);
    ASSERT_EQ(numbers(found), numbers(plain));
    ASSERT_EQ(found.admissible, plain.admissible);
    ASSERT_EQ(found.total, plain.total);
    ASSERT_EQ(found.left_out.unstable, plain.left_out.unstable);
    ASSERT_EQ(found.active.size(), plain.active.size());
    for (std::size_t j = 0; j < found.active.size(); ++j) {
      ++priced;
      ASSERT_EQ(found.active[j].optimum.number, plain.active[j].optimum.number);
      ASSERT_EQ(found.active[j].loosened->found.number, plain.active[j].loosened->found.number);
    }
  }
  EXPECT_GT(priced, kCases / 2);
}

TEST_F(Skipping, changes_no_front) {
  std::size_t points = 0;
  for (int i = 0; i < kCases; ++i) {
    draw();
    const ParetoQuestion both{{parse_expression({"", "IAE_w"}), parse_expression({"", "TV2_uw + kappa"})},
                              conditions()};
    const ParetoAnswer found = pareto(*knowing_, both), plain = pareto(*scanning_, both);
    ASSERT_EQ(found.admissible, plain.admissible);
    ASSERT_EQ(found.front.size(), plain.front.size());
    for (std::size_t k = 0; k < found.front.size(); ++k) ASSERT_EQ(found.front[k].number, plain.front[k].number);
    points += found.front.size();
  }
  EXPECT_GT(points, 100u);
}

TEST_F(Skipping, changes_no_region_nearest_setting_or_trade_off) {
  for (int i = 0; i < kCases; ++i) {
    draw();
    const Region found = region(*knowing_, conditions()), plain = region(*scanning_, conditions());
    for (std::size_t k = 0; k < found.axes.size(); ++k) ASSERT_EQ(found.axes[k].counts, plain.axes[k].counts);
    const Setting from = setting_at(knowing_->grid(), random_() % setting_count(knowing_->grid()));
    const auto near = nearest_admissible(*knowing_, conditions(), from);
    if (i % 10 == 0) {  // a second each
      ASSERT_EQ(near ? near->distance : kInf, least_distance(from));
    }
    const std::vector<double> bounds = {0.5, 1, 1.3, 1.6, 2};
    const Expression along = parse_expression({"", "TV2_uw"});
    const auto points = trade_off(*knowing_, asked_, along, bounds);
    const auto scanned = trade_off(*scanning_, asked_, along, bounds);
    for (std::size_t k = 0; k < bounds.size(); ++k) {
      ASSERT_EQ(points[k].best.has_value(), scanned[k].best.has_value());
      if (points[k].best) {
        ASSERT_EQ(points[k].best->number, scanned[k].best->number);
      }
    }
  }
}

}  // namespace
}  // namespace portrait
