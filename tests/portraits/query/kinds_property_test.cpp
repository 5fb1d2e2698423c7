/// Front, region, nearest setting and trade-off over random portraits, against plain loops.
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "engine/base/error.h"
#include "grids/tiling.h"
#include "portraits/query/pareto.h"
#include "portraits/query/region.h"
#include "portraits/query/trade_off.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/random_question.h"

namespace portrait {
namespace {

/// A random question that fits its portrait; the property is discarded otherwise.
struct Drawn {
  MemorySource source = random_source(random_grid());
  Case one = random_case(source.grid());

  Drawn() {
    bool fits = true;
    try {
      require_answerable(one.question.conditions, source.grid());
    } catch (const InputError&) {
      fits = false;
    }
    RC_PRE(fits);
  }
  const Conditions& conditions() const { return one.question.conditions; }

  /// The settings that the query calls admissible under an objective that always exists: held by the other tests.
  std::vector<std::uint64_t> admissible() const {
    Question all = one.question;
    all.minimize = parse_expression({"test", "0"});
    all.top = kMaxTop;
    std::vector<std::uint64_t> numbers;
    const Answer answer = ask(source, all);
    for (const Found& found : answer.top) numbers.push_back(found.number);
    return numbers;
  }
  double value(const Expression& expression, std::uint64_t number) const {
    const Found found = found_at(source, conditions().units, number, 0);
    return value_at(expression, {found.setting, found.status, found.measures, conditions().units.plant});
  }
};

Expression expression(const std::string& text) { return parse_expression({"test", text}); }

RC_GTEST_PROP(Pareto, is_what_comparing_all_pairs_gives, ()) {
  const Drawn drawn;
  const std::vector<std::string> texts = {"IAE_w", "IAE_d - IAE_w", "TV2_uw"};
  ParetoQuestion question{{}, drawn.conditions(), *rc::gen::inRange<std::size_t>(2, 9)};
  const std::size_t objectives = *rc::gen::inRange<std::size_t>(2, 4);
  for (std::size_t k = 0; k < objectives; ++k) question.minimize.push_back(expression(texts[k]));
  std::vector<FrontPoint> all;
  for (const std::uint64_t number : drawn.admissible()) {
    FrontPoint point{number, {}};
    bool exists = true;
    for (std::size_t k = 0; k < objectives; ++k) {
      point.values[k] = drawn.value(question.minimize[k], number);
      exists = exists && !std::isnan(point.values[k]);
    }
    if (exists) all.push_back(point);
  }
  const ParetoAnswer answer = pareto(drawn.source, question);
  RC_ASSERT(answer.admissible == all.size());
  std::vector<std::uint64_t> expected, found;
  for (const FrontPoint& point : all)
    if (std::none_of(all.begin(), all.end(), [&](const FrontPoint& other) {
          return dominates(other, point) || (other.values == point.values && other.number < point.number);
        }))
      expected.push_back(point.number);
  for (const FrontPoint& point : answer.front) found.push_back(point.number);
  std::sort(found.begin(), found.end());
  RC_ASSERT(found == expected);
  RC_ASSERT(std::is_sorted(answer.front.begin(), answer.front.end(),
                           [](const FrontPoint& a, const FrontPoint& b) { return a.values < b.values; }));
  RC_ASSERT(answer.subset.size() <= question.subset);
  if (!answer.front.empty()) RC_ASSERT(answer.subset.front() == 0u);
}

TEST(Pareto, knee_and_subset_of_a_known_front) {
  std::vector<FrontPoint> front;
  for (int i = 0; i <= 100; ++i) {
    const double x = 1 + 0.01 * i;
    front.push_back({static_cast<std::uint64_t>(i), {x, 3 / x, 0}});
  }
  // Scaled, f = x - 1 and g = (3/x - 1.5)/1.5: their sum is least where 1 = 2/x^2.
  EXPECT_EQ(knee_of(front, 2), 41u);
  const std::vector<std::size_t> three = even_subset(front, 2, 3);
  ASSERT_EQ(three.size(), 3u);
  EXPECT_EQ(three.front(), 0u);
  EXPECT_EQ(three.back(), 100u);
  EXPECT_NEAR(static_cast<double>(three[1]), 41, 8);
  EXPECT_EQ(even_subset(front, 2, 1000).size(), 101u);
}

TEST(Pareto, knee_is_the_least_sum_of_scaled_values) {
  // Scaled: 0 1 1, 0.5 0 0.25, 1 0.5 0: sums 2, 0.75, 1.5.
  EXPECT_EQ(knee_of({{1, {10, 6, 9}}, {2, {20, 2, 6}}, {3, {30, 4, 5}}}, 3), 1u);
  // The third is 7 everywhere, so that it counts for nothing.
  EXPECT_EQ(knee_of({{1, {1, 3, 7}}, {2, {2, 1.2, 7}}, {3, {3, 1, 7}}}, 3), 1u);
  // inf counts as the worst, the others as if it were not there: 0 1, 0.1 1, 0.5 0.1, 1 0.
  EXPECT_EQ(knee_of({{1, {0, kInf, 0}}, {2, {0.2, 3, 0}}, {3, {1, 1.2, 0}}, {4, {2, 1, 0}}}, 2), 2u);
  // -inf as the best: 0 1, 0.1 0, 1 0 in the first and last.
  EXPECT_EQ(knee_of({{1, {0, 1, 4}}, {2, {0.1, 0, 5}}, {3, {1, -kInf, 6}}}, 2), 1u);
  EXPECT_EQ(knee_of({{1, {1, 3, 0}}, {2, {3, 1, 0}}}, 2), 0u);  // equal sums: the first
  // Only differences count: 0 1, 0.6 0.3, 1 0.
  EXPECT_EQ(knee_of({{1, {100, 1, 0}}, {2, {100.6, 0.3, 0}}, {3, {101, 0, 0}}}, 2), 1u);
}

TEST(Pareto, a_subset_goes_on_from_the_ends_to_what_is_farthest) {
  const std::vector<FrontPoint> front = {
      {1, {0, 10, 0}}, {2, {1, 9, 0}}, {3, {6, 4, 0}}, {4, {9, 1, 0}}, {5, {10, 0, 0}}};
  EXPECT_EQ(even_subset(front, 2, 2), (std::vector<std::size_t>{0, 4}));
  EXPECT_EQ(even_subset(front, 2, 3), (std::vector<std::size_t>{0, 2, 4}));
  EXPECT_EQ(even_subset(front, 2, 5).size(), 5u);
  EXPECT_EQ(even_subset({{1, {3, 3, 0}}}, 2, 4), std::vector<std::size_t>{0});
  // Squares of distances to the nearer end, in each value and their sum: 0.0025 and 0.36, 0.25 and 0.01; then mirrored.
  EXPECT_EQ(even_subset({{1, {0, 10, 0}}, {2, {0.5, 4, 0}}, {3, {5, 1, 0}}, {4, {10, 0, 0}}}, 2, 3)[1], 1u);
  EXPECT_EQ(even_subset({{1, {0, 10, 0}}, {2, {1, 5, 0}}, {3, {4, 0.5, 0}}, {4, {10, 0, 0}}}, 2, 3)[1], 2u);
  // Only the third tells the middle ones apart.
  EXPECT_EQ(even_subset({{1, {0, 2, 5}}, {2, {1, 1, 5}}, {3, {1, 1.2, 0}}, {4, {2, 0, 5}}}, 3, 3)[1], 2u);
  // Two infinite values cannot be told apart.
  EXPECT_EQ(even_subset({{1, {kInf, 1, 2}}, {2, {kInf, 1, 2}}, {3, {1, 4, 2}}}, 2, 3).size(), 2u);
}

TEST(Pareto, a_point_dominates_what_is_nowhere_better_and_somewhere_worse) {
  const FrontPoint a{1, {1, 2, 3}};
  EXPECT_FALSE(dominates(a, a));
  EXPECT_TRUE(dominates(a, {2, {1, 2, 4}}));
  EXPECT_TRUE(dominates(a, {2, {2, 2, 3}}));
  EXPECT_FALSE(dominates(a, {2, {0, 9, 9}}));
  EXPECT_FALSE(dominates(a, {2, {9, 9, 2}}));
}

/// kappa 0.1, 0.2, ... in tiles; IAE_w and TV2_uw by tile, IAE_d 1.
MemorySource in_tiles(const std::vector<std::pair<double, double>>& values) {
  Grid grid;
  grid.family = {Plant::ipdt, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w, Measure::IAE_d, Measure::TV2_uw};
  const std::uint64_t settings = values.size() * kTileSettings;
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.1 * static_cast<double>(settings), settings)};
  grid.fixed = {{Parameter::delta, 0.5}, {Parameter::tau_i, 8}};
  MemorySource source(grid);
  for (std::uint64_t i = 0; i < settings; ++i) {
    source.at(Measure::IAE_w, i) = values[i / kTileSettings].first;
    source.at(Measure::TV2_uw, i) = values[i / kTileSettings].second;
  }
  return source;
}

ParetoQuestion in_both(const std::vector<std::string>& where = {}) {
  ParetoQuestion question{{expression("IAE_w"), expression("TV2_uw")}, {}};
  for (const std::string& text : where) question.conditions.where.push_back(parse_constraint({"", text}));
  return question;
}

TEST(Pareto, counts_a_beaten_tile_without_reading_it) {
  MemorySource source = in_tiles({{2, 2}, {3, 2}, {1, 3}});
  source.status(kTileSettings + 1) = Status::not_settled;
  const ParetoAnswer answer = pareto(source, in_both());
  ASSERT_EQ(answer.front.size(), 2u);
  EXPECT_EQ(answer.front[0].number, 2 * kTileSettings);
  EXPECT_EQ(answer.front[1].number, 0u);
  EXPECT_EQ(answer.admissible, 3 * kTileSettings - 1);
  EXPECT_EQ(answer.total, 3 * kTileSettings);
  EXPECT_EQ(source.values_read(), 2 * 2 * kTileSettings);
}

TEST(Pareto, reads_of_a_beaten_tile_only_what_decides_who_is_admissible) {
  MemorySource source = in_tiles({{2, 2}, {3, 3}});
  source.at(Measure::IAE_d, kTileSettings + 7) = 9;
  const ParetoAnswer answer = pareto(source, in_both({"IAE_d <= 2"}));
  EXPECT_EQ(answer.front.size(), 1u);
  EXPECT_EQ(answer.admissible, 2 * kTileSettings - 1);
  EXPECT_EQ(source.values_read(), 3 * kTileSettings);
}

TEST(Pareto, a_beaten_tile_with_a_missing_value_is_counted_setting_by_setting) {
  MemorySource source = in_tiles({{2, 2}, {3, 3}});
  source.at(Measure::TV2_uw, kTileSettings + 7) = kNaN;
  const ParetoAnswer answer = pareto(source, in_both());
  EXPECT_EQ(answer.admissible, 2 * kTileSettings - 1);
  EXPECT_EQ(answer.left_out.objective_missing, 1u);
}

TEST(Pareto, refuses_a_question_that_is_not_of_a_front) {
  const MemorySource source = in_tiles({{1, 1}});
  ParetoQuestion one = in_both(), four = in_both(), small = in_both();
  one.minimize.pop_back();
  four.minimize.push_back(expression("IAE_d"));
  EXPECT_EQ(pareto(source, four).front.size(), 1u);
  four.minimize.push_back(expression("kappa"));
  small.subset = 1;
  for (const ParetoQuestion& question : {one, four, small}) EXPECT_THROW(pareto(source, question), InputError);
  small.subset = 2;
  EXPECT_EQ(pareto(source, small).subset.size(), 1u);
}

RC_GTEST_PROP(Region, is_what_a_plain_loop_counts, ()) {
  const Drawn drawn;
  const Grid& grid = drawn.source.grid();
  const Region found = region(drawn.source, drawn.conditions());
  const std::vector<std::uint64_t> admissible = drawn.admissible();
  RC_ASSERT(found.admissible == admissible.size());
  for (std::size_t k = 0; k < grid.axes.size(); ++k) {
    std::vector<std::uint64_t> counts(grid.axes[k].size());
    for (const std::uint64_t number : admissible) ++counts[coordinates(grid, number)[k]];
    RC_ASSERT(found.axes[k].counts == counts);
    std::optional<std::size_t> first, last;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] > 0 && !first) first = i;
      if (counts[i] > 0) last = i;
    }
    RC_ASSERT(found.axes[k].first == first);
    RC_ASSERT(found.axes[k].last == last);
    RC_ASSERT(found.axes[k].at_lower_edge == (counts.front() > 0));
    const bool ends_in_inf = std::isinf(grid.axes[k][counts.size() - 1]);
    RC_ASSERT(found.axes[k].at_upper_edge == (counts.back() > 0 && !ends_in_inf));
  }
}

/// Pearson's, of the indices along two axes over these settings; NaN where one of them is the same everywhere.
double plain_correlation(const Grid& grid, const std::vector<std::uint64_t>& settings, std::size_t j,
                         std::size_t k) {
  const auto n = static_cast<double>(settings.size());
  double mean_j = 0, mean_k = 0, jj = 0, jk = 0, kk = 0;
  for (const std::uint64_t number : settings) {
    mean_j += static_cast<double>(coordinates(grid, number)[j]) / n;
    mean_k += static_cast<double>(coordinates(grid, number)[k]) / n;
  }
  for (const std::uint64_t number : settings) {
    const double a = static_cast<double>(coordinates(grid, number)[j]) - mean_j;
    const double b = static_cast<double>(coordinates(grid, number)[k]) - mean_k;
    jj += a * a, jk += a * b, kk += b * b;
  }
  return jj < 1e-6 || kk < 1e-6 ? kNaN : jk / std::sqrt(jj * kk);
}

RC_GTEST_PROP(Region, correlations_are_those_of_the_indices, ()) {
  const Drawn drawn;
  const Grid& grid = drawn.source.grid();
  const std::size_t axes = grid.axes.size();
  const std::vector<std::uint64_t> admissible = drawn.admissible();
  RC_PRE(!admissible.empty() && admissible.size() < 4000);
  const Region found = region(drawn.source, drawn.conditions());
  RC_ASSERT(found.correlation.size() == axes * axes);
  for (std::size_t j = 0; j < axes; ++j)
    for (std::size_t k = 0; k < axes; ++k) {
      const double expected = plain_correlation(grid, admissible, j, k), value = found.correlation[j * axes + k];
      RC_ASSERT(std::isnan(expected) == std::isnan(value));
      if (!std::isnan(expected)) RC_ASSERT(std::abs(value - expected) < 1e-6);
    }
}

TEST(Region, an_axis_has_places_from_0_to_1_and_beyond) {
  const Axis even = Axis::linear(Parameter::kappa, 1, 3, 3), uneven = Axis::list(Parameter::tau_i, {2, 4, 12});
  EXPECT_EQ(place_on(even, 1), 0);
  EXPECT_EQ(place_on(even, 2), 0.5);
  EXPECT_EQ(place_on(even, 3), 1);
  EXPECT_EQ(place_on(even, 0), -0.5);
  EXPECT_EQ(place_on(even, 5), 2);
  EXPECT_EQ(place_on(even, kInf), kInf);
  EXPECT_EQ(place_on(uneven, 3), 0.25);
  EXPECT_EQ(place_on(uneven, 4), 0.5);
  EXPECT_EQ(place_on(uneven, 6), 0.625);
  EXPECT_EQ(place_on(uneven, 20), 1.5);
  const Axis to_inf = Axis::list(Parameter::tau_i, {2, 4, kInf});
  EXPECT_EQ(place_on(to_inf, 2), 0);
  EXPECT_EQ(place_on(to_inf, 3), 0.25);
  EXPECT_EQ(place_on(to_inf, 4), 0.5);
  EXPECT_EQ(place_on(to_inf, 6), 1);
  EXPECT_EQ(place_on(to_inf, kInf), 1);
  EXPECT_EQ(place_on(Axis::list(Parameter::tau_i, {4, kInf}), 9), 0);
  EXPECT_EQ(place_on(Axis::list(Parameter::tau_i, {4}), 9), 0);
}

/// From setting to setting.
std::vector<std::vector<std::uint64_t>> searched_pieces(const Grid& grid,
                                                        const std::vector<std::uint64_t>& admissible) {
  std::set<std::uint64_t> left(admissible.begin(), admissible.end());
  std::vector<std::vector<std::uint64_t>> pieces;
  while (!left.empty()) {
    std::vector<std::uint64_t> piece = {*left.begin()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const std::uint64_t other : std::vector<std::uint64_t>(left.begin(), left.end())) {
        std::uint64_t apart = 0;
        const auto a = coordinates(grid, piece[i]), b = coordinates(grid, other);
        for (std::size_t k = 0; k < a.size(); ++k) apart += a[k] > b[k] ? a[k] - b[k] : b[k] - a[k];
        if (apart != 1) continue;
        piece.push_back(other);
        left.erase(other);
      }
    std::sort(piece.begin(), piece.end());
    pieces.push_back(piece);
  }
  return pieces;
}

RC_GTEST_PROP(Region, pieces_are_what_a_search_finds, ()) {
  const Drawn drawn;
  const Grid& grid = drawn.source.grid();
  std::vector<std::uint64_t> admissible = drawn.admissible();
  RC_PRE(admissible.size() < 400);
  std::sort(admissible.begin(), admissible.end());
  auto expected = searched_pieces(grid, admissible);
  std::stable_sort(expected.begin(), expected.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  const Region found = region(drawn.source, drawn.conditions());
  RC_ASSERT(found.pieces.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Piece& piece = found.pieces[i];
    RC_ASSERT(piece.settings == expected[i].size());
    RC_ASSERT(piece.lowest == expected[i].front());
    for (std::size_t k = 0; k < grid.axes.size(); ++k) {
      std::uint64_t least = ~std::uint64_t{0}, most = 0;
      for (const std::uint64_t number : expected[i]) {
        least = std::min(least, coordinates(grid, number)[k]);
        most = std::max(most, coordinates(grid, number)[k]);
      }
      RC_ASSERT(piece.first[k] == least);
      RC_ASSERT(piece.last[k] == most);
    }
  }
}

RC_GTEST_PROP(Region, the_nearest_setting_is_nearest, ()) {
  const Drawn drawn;
  const Grid& grid = drawn.source.grid();
  const std::uint64_t from = *rc::gen::inRange<std::uint64_t>(0, setting_count(grid));
  Setting setting = setting_at(grid, from);
  if (*rc::gen::arbitrary<bool>()) setting.kappa *= 1.03;
  const auto found = nearest_admissible(drawn.source, drawn.conditions(), setting);
  std::optional<std::uint64_t> expected;
  double least = kInf;
  for (const std::uint64_t number : drawn.admissible()) {
    double sum = 0;
    for (const Axis& axis : grid.axes) {
      const double apart =
          place_on(axis, get(setting, axis.parameter())) -
          place_on(axis, axis[coordinates(grid, number)[static_cast<std::size_t>(&axis - grid.axes.data())]]);
      sum += apart * apart;
    }
    if (!expected || std::sqrt(sum) < least) {
      expected = number;
      least = std::sqrt(sum);
    }
  }
  RC_ASSERT(found.has_value() == expected.has_value());
  if (!found) return;
  RC_ASSERT(found->distance == least);
  RC_ASSERT(found->found.number == *expected);
}

TEST(Region, a_nearest_setting_is_looked_for_only_in_tiles_that_are_near_enough) {
  Grid grid;
  grid.family = {Plant::ipdt, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.2, 2),
               Axis::linear(Parameter::tau_i, 2, 20, 4 * kTileSettings)};
  grid.fixed = {{Parameter::delta, 0.5}};
  MemorySource source(grid);
  for (std::uint64_t i = 0; i < setting_count(grid); i += kTileSettings) source.at(Measure::IAE_w, i) = 9;
  Conditions conditions;
  conditions.where.push_back(parse_constraint({"", "IAE_w <= 2"}));
  const auto found = nearest_admissible(source, conditions, setting_at(grid, 5));
  EXPECT_EQ(found->found.number, 5u);
  EXPECT_EQ(source.values_read(), kTileSettings + 1);
}

RC_GTEST_PROP(TradeOff, is_one_query_a_bound, ()) {
  const Drawn drawn;
  const std::vector<double> bounds = {0.25, 1, 2, 3.5, 9};
  const Expression along = expression("TV2_uw");
  const auto points = trade_off(drawn.source, drawn.one.question, along, bounds);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    Question asked = drawn.one.question;
    asked.conditions.where.push_back(bound_constraint(along, bounds[i]));
    const Answer answer = ask(drawn.source, asked);
    RC_ASSERT(points[i].best.has_value() == !answer.top.empty());
    if (points[i].best) RC_ASSERT(points[i].best->number == answer.top[0].number);
  }
}

TEST(TradeOff, reads_only_tiles_that_may_hold_the_best_within_a_bound) {
  MemorySource source = in_tiles({{1, 1}, {2, 1}, {0.5, 9}, {0.7, 2}, {0.8, 2}});
  Question question{expression("IAE_w"), {}};
  const auto points = trade_off(source, question, expression("TV2_uw"), {0.5, 1, 3});
  EXPECT_FALSE(points[0].best);
  EXPECT_EQ(points[1].best->number, 0u);
  EXPECT_EQ(points[2].best->number, 3 * kTileSettings);
  EXPECT_EQ(source.values_read(),
            2 * 2 * kTileSettings + 2 * 3);  // the first and fourth tile, and what the answer takes
  // The same without a bound that none meets.
  EXPECT_EQ(trade_off(source, question, expression("TV2_uw"), {1, 3})[0].best->number, 0u);
  EXPECT_EQ(source.values_read(), 2 * (2 * 2 * kTileSettings + 2 * 3));
}

/// The constraints in another order, one of them twice.
RC_GTEST_PROP(QueryInvariance, order_and_repetition_of_constraints_change_nothing, ()) {
  const Drawn drawn;
  const Answer before = ask(drawn.source, drawn.one.question);
  Question asked = drawn.one.question;
  std::reverse(asked.conditions.where.begin(), asked.conditions.where.end());
  if (!asked.conditions.where.empty()) asked.conditions.where.push_back(asked.conditions.where.front());
  const Answer after = ask(drawn.source, asked);
  RC_ASSERT(after.admissible == before.admissible);
  RC_ASSERT(after.top.size() == before.top.size());
  for (std::size_t i = 0; i < after.top.size(); ++i) RC_ASSERT(after.top[i].number == before.top[i].number);
}

RC_GTEST_PROP(QueryInvariance, loosening_never_worsens, ()) {
  const Drawn drawn;
  Question tight = drawn.one.question, loose = drawn.one.question;
  const double bound = *rc::gen::element(0.5, 1.0, 3.0, 7.0), more = *rc::gen::element(0.0, 0.3, 4.0);
  tight.conditions.where.push_back(bound_constraint(expression("IAE_d"), bound));
  loose.conditions.where.push_back(bound_constraint(expression("IAE_d"), bound + more));
  const Answer few = ask(drawn.source, tight), many = ask(drawn.source, loose);
  RC_ASSERT(many.admissible >= few.admissible);
  if (few.top.empty()) return;
  RC_ASSERT(!many.top.empty());
  RC_ASSERT(many.top[0].objective <= few.top[0].objective);
}

}  // namespace
}  // namespace portrait
