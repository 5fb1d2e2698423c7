#include "portraits/query/query.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "portraits/query/select_pass.h"
#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/small_portraits.h"

namespace portrait {
namespace {

TEST(Query, finds_the_smallest_objective) {
  const Answer answer = ask(five({5, 4, 3, 4, 5}, {1, 1, 1, 1, 1}), question("IAE_w"));
  ASSERT_EQ(answer.top.size(), 1u);
  const Found& best = answer.top[0];
  EXPECT_EQ(best.number, 2u);
  EXPECT_EQ(best.objective, 3);
  EXPECT_EQ(best.status, Status::settled);
  EXPECT_EQ(best.setting.kappa, 0.3);
  EXPECT_EQ(best.setting.delta, 0.5);
  EXPECT_EQ(best.setting.tau_i, 8);
  EXPECT_EQ(best.measures[Measure::IAE_w], 3);
  EXPECT_EQ(best.measures[Measure::IAE_d], 30);
  EXPECT_TRUE(std::isnan(best.measures[Measure::Ms]));
  EXPECT_EQ(answer.admissible, 5u);
  EXPECT_EQ(answer.total, 5u);
  EXPECT_TRUE(answer.active.empty());
  EXPECT_FALSE(answer.strictest);
  EXPECT_FALSE(answer.near_miss);
}

TEST(Query, top_is_sorted_and_ties_go_to_the_lower_number) {
  const MemorySource source = five({2, 1, 2, 1, 3}, {1, 1, 1, 1, 1});
  ASSERT_EQ(numbers(ask(source, question("IAE_w", {}, 3))), (Numbers{1, 3, 0}));
  ASSERT_EQ(numbers(ask(source, question("IAE_w", {}, 4))), (Numbers{1, 3, 0, 2}));
  ASSERT_EQ(numbers(ask(source, question("IAE_w", {}, 99))), (Numbers{1, 3, 0, 2, 4}));
  ASSERT_EQ(numbers(ask(source, question("0", {}, 2))), (Numbers{0, 1}));
}

TEST(Query, only_settings_under_every_constraint_count) {
  Question asked = question("IAE_w", {"TV2_uw <= 3", "kappa == 0.4"});
  EXPECT_TRUE(ask(five({1, 2, 3, 4, 5}, {9, 8, 3, 2, 1}), asked).excluded.empty());
  asked.count_excluded = true;
  const Answer answer = ask(five({1, 2, 3, 4, 5}, {9, 8, 3, 2, 1}), asked);
  ASSERT_EQ(numbers(answer), Numbers{3});
  EXPECT_EQ(answer.admissible, 1u);
  EXPECT_EQ(answer.excluded, (Numbers{2, 4}));
}

TEST(Query, counts_what_is_left_out_and_why) {
  MemorySource source = five({kNaN, 2, 3, kNaN, 5}, {kNaN, 1, 1, 1, 1});
  source.at(Measure::IAE_d, 0) = kNaN;
  source.status(0) = Status::unstable;
  source.status(1) = Status::not_settled;
  source.status(2) = Status::not_computed;
  Question asked = question("IAE_w");
  const Answer answer = ask(source, asked);
  ASSERT_EQ(numbers(answer), Numbers{4});
  EXPECT_EQ(answer.left_out.unstable, 1u);
  EXPECT_EQ(answer.left_out.not_settled, 1u);
  EXPECT_EQ(answer.left_out.not_computed, 1u);
  EXPECT_EQ(answer.left_out.objective_missing, 1u);
  EXPECT_EQ(answer.admissible, 1u);
  EXPECT_EQ(answer.total, 5u);
  asked.conditions.include_not_settled = true;
  const Answer with = ask(source, asked);
  ASSERT_EQ(numbers(with), Numbers{1});
  EXPECT_EQ(with.top[0].status, Status::not_settled);
  EXPECT_EQ(with.left_out.not_settled, 0u);
  EXPECT_EQ(with.admissible, 2u);
}

TEST(Query, nan_in_a_constraint_makes_a_setting_inadmissible) {
  Question asked = question("IAE_w", {"TV2_uw <= 3"});
  asked.count_excluded = true;
  const Answer answer = ask(five({1, 2, 3, 4, 5}, {kNaN, kNaN, 1, 1, 1}), asked);
  ASSERT_EQ(numbers(answer), Numbers{2});
  EXPECT_EQ(answer.excluded, Numbers{2});
}

TEST(Query, an_infinite_objective_is_admissible) {
  const Answer answer =
      ask(five({kInf, kInf, kInf, kInf, kInf}, {9, 1, 1, 1, 1}), question("IAE_w", {"TV2_uw <= 3"}));
  ASSERT_EQ(numbers(answer), Numbers{1});
  EXPECT_TRUE(answer.active.empty());
}

TEST(Query, active_constraints_are_those_whose_removal_alone_helps) {
  //                       kappa  0.1 0.2 0.3 0.4 0.5
  const MemorySource source = five({1, 2, 3, 4, 5}, {9, 8, 7, 2, 1});
  const Answer answer =
      ask(source, question("IAE_w", {"TV2_uw <= 2", "IAE_d >= 20", "kappa <= 0.45", "IAE_w > 0"}));
  ASSERT_EQ(numbers(answer), Numbers{3});
  ASSERT_EQ(answer.active.size(), 1u);  // setting 0 fails two, setting 4 is no better
  EXPECT_EQ(answer.active[0].constraint, 0u);
  EXPECT_EQ(answer.active[0].optimum.number, 1u);
  EXPECT_EQ(answer.active[0].optimum.objective, 2);
  EXPECT_EQ(answer.active[0].optimum.setting.kappa, 0.2);
}

TEST(Query, removal_that_only_ties_is_not_active) {
  const Answer answer = ask(five({2, 2, 3, 4, 5}, {9, 1, 1, 1, 1}), question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(numbers(answer), Numbers{1});
  EXPECT_TRUE(answer.active.empty());
}

TEST(Query, explains_why_nothing_is_admissible) {
  const MemorySource source = five({1, 2, 3, 4, 5}, {9, 8, 7, 6, 5});
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 4", "IAE_w <= 2"}));
  EXPECT_TRUE(answer.top.empty());
  EXPECT_EQ(answer.admissible, 0u);
  EXPECT_EQ(answer.excluded, (Numbers{5, 3}));
  EXPECT_EQ(answer.strictest, 0u);
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].constraint, 0u);
  EXPECT_EQ(answer.active[0].optimum.number, 0u);
  ASSERT_TRUE(answer.near_miss);  // largest violations 1.25, 1, 0.75, 1, 1.5
  EXPECT_EQ(answer.near_miss->found.number, 2u);
  ASSERT_EQ(answer.near_miss->violations.size(), 2u);
  const Violation& first = answer.near_miss->violations[0];
  EXPECT_EQ(first.constraint, 0u);
  EXPECT_EQ(first.left, 7);
  EXPECT_EQ(first.right, 4);
  EXPECT_EQ(first.relative, 0.75);
  EXPECT_EQ(answer.near_miss->violations[1].relative, 0.5);
}

TEST(Query, a_strict_relation_may_be_missed_by_nothing) {
  const Answer answer = ask(five({1, 2, 3, 4, 5}, {4, 3, 2, 2, 2}), question("IAE_w", {"TV2_uw < 2"}));
  ASSERT_TRUE(answer.near_miss);
  EXPECT_EQ(answer.near_miss->found.number, 2u);
  ASSERT_EQ(answer.near_miss->violations.size(), 1u);
  EXPECT_EQ(answer.near_miss->violations[0].relative, 0);
}

TEST(Query, a_near_miss_may_be_infinitely_far) {
  const Answer answer =
      ask(five({kNaN, 2, 3, 4, 5}, std::vector<double>(5, kInf)), question("IAE_w", {"TV2_uw <= 4"}));
  ASSERT_TRUE(answer.near_miss);
  EXPECT_EQ(answer.near_miss->found.number, 1u);
  ASSERT_EQ(answer.near_miss->violations.size(), 1u);
  EXPECT_EQ(answer.near_miss->violations[0].relative, kInf);
}

TEST(Query, no_near_miss_without_numbers) {
  const Answer nan = ask(five({1, 2, 3, 4, 5}, std::vector<double>(5, kNaN)), question("IAE_w", {"TV2_uw <= 4"}));
  EXPECT_FALSE(nan.near_miss);
  EXPECT_EQ(nan.strictest, 0u);
  const Answer none = ask(five(std::vector<double>(5, kNaN), {1, 1, 1, 1, 1}), question("IAE_w", {"TV2_uw <= 4"}));
  EXPECT_FALSE(none.near_miss);
  EXPECT_FALSE(none.strictest);
  EXPECT_EQ(none.left_out.objective_missing, 5u);
}

TEST(Query, of_a_single_setting) {
  Grid grid = line(2);
  grid.axes.clear();
  grid.fixed.push_back({Parameter::kappa, 0.25});
  const Answer answer = ask(MemorySource(grid), question("IAE_w + kappa", {"tau_d == 2"}));
  ASSERT_EQ(numbers(answer), Numbers{0});
  EXPECT_EQ(answer.top[0].objective, 1.25);
}

TEST(Query, tiles_meet_without_gap_or_overlap) {
  for (const std::uint64_t total : {kTileSettings - 1, kTileSettings, kTileSettings + 1, 2 * kTileSettings + 3}) {
    MemorySource source(line(total));
    for (const std::uint64_t best : {std::uint64_t{0}, total / 2, kTileSettings - 2, total - 1}) {
      source.at(Measure::IAE_w, best) = -1;
      Question asked = question("IAE_w", {"IAE_w < 0", "IAE_d == 1"});
      asked.count_excluded = true;
      const Answer answer = ask(source, asked);
      ASSERT_EQ(numbers(answer), Numbers{best}) << total;
      EXPECT_EQ(answer.admissible, 1u);
      EXPECT_EQ(answer.total, total);
      EXPECT_EQ(answer.excluded, (Numbers{total - 1, 0}));
      source.at(Measure::IAE_w, best) = 1;
    }
  }
}

/// What the answer itself takes: every measure of the one setting.
constexpr std::uint64_t kOfTheAnswer = 3;

/// And the objective once more, to see what the constraints cost.
TEST(Query, without_summaries_reads_each_column_in_use_once_in_tiles) {
  const std::uint64_t total = 3 * kTileSettings;
  MemorySource source(line(total));
  source.know_summaries(false);
  ask(source, question("IAE_w", {"IAE_w + TV2_uw <= 9", "kappa < 1000"}));
  EXPECT_EQ(source.values_read(), 3 * total + kOfTheAnswer);
  EXPECT_EQ(source.longest_read(), kTileSettings);
}

TEST(Query, reads_no_tile_that_its_range_rules_out) {
  MemorySource source(line(4 * kTileSettings));
  for (std::uint64_t i = 0; i < 4 * kTileSettings; ++i) source.at(Measure::TV2_uw, i) = static_cast<double>(i);
  const double bound = 1.5 * kTileSettings;
  source.at(Measure::IAE_w, 3 * kTileSettings) = 0.5;  // better, but excluded
  const Answer answer = ask(source, question("IAE_w", {fmt::format("TV2_uw <= {}", bound)}));
  EXPECT_EQ(answer.admissible, static_cast<std::uint64_t>(bound) + 1);
  ASSERT_EQ(numbers(answer), Numbers{0});
  // IAE_w of the first, admissible throughout; TV2_uw of the second, whose IAE_w is 1 as well and so is read too; both
  // of the last for the price.
  EXPECT_EQ(source.values_read(), 5 * kTileSettings + 2 * kOfTheAnswer + kOfTheAnswer);
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.number, 3 * kTileSettings);
}

TEST(Query, reads_only_what_may_hold_the_best) {
  MemorySource source(line(100 * kTileSettings));
  for (std::uint64_t i = 0; i < 100 * kTileSettings; ++i)
    source.at(Measure::IAE_w, i) = std::abs(static_cast<double>(i) - 70.5 * kTileSettings);
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 1"}));
  ASSERT_EQ(numbers(answer), Numbers{70 * kTileSettings + kTileSettings / 2});
  EXPECT_EQ(answer.admissible, 100 * kTileSettings);
  EXPECT_LE(source.values_read(), 40 * kTileSettings);  // threads take tiles sixteen at a time
}

TEST(Query, skips_measures_where_nothing_is_stable) {
  MemorySource source(line(2 * kTileSettings));
  for (std::uint64_t i = 0; i < kTileSettings; ++i) source.status(i) = Status::unstable;
  ask(source, question("IAE_w"));
  EXPECT_EQ(source.values_read(), kTileSettings + kOfTheAnswer);
}

TEST(Query, unstable_settings_of_a_tile_say_nothing_of_its_others) {
  MemorySource source(line(2 * kTileSettings));
  for (std::uint64_t i = kTileSettings; i < 2 * kTileSettings; ++i) {
    const bool unstable = i % 3 == 0;
    source.status(i) = unstable ? Status::unstable : Status::settled;
    source.at(Measure::IAE_w, i) = unstable ? kNaN : 5;
  }
  const Answer answer = ask(source, question("IAE_w"));
  EXPECT_EQ(answer.admissible + answer.left_out.unstable, 2 * kTileSettings);
  EXPECT_EQ(source.values_read(), kTileSettings + kOfTheAnswer);
}

TEST(Query, the_price_of_a_constraint_is_the_least_loosening_that_helps) {
  const MemorySource source = five({1, 2, 3, 4, 5}, {9, 8, 7, 2, 1});
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.number, 0u);
  ASSERT_TRUE(answer.active[0].loosened);  // TV2_uw <= 7 lets setting 2 in
  EXPECT_EQ(answer.active[0].loosened->found.number, 2u);
  EXPECT_EQ(answer.active[0].loosened->left, 7);
  EXPECT_EQ(answer.active[0].loosened->right, 2);
  EXPECT_EQ(answer.active[0].loosened->relative, 2.5);
}

/// One measure's value for all of a tile.
void fill(MemorySource& source, Measure measure, std::uint64_t tile, double value) {
  for (std::uint64_t i = 0; i < kTileSettings; ++i) source.at(measure, tile * kTileSettings + i) = value;
}

/// Tiles whose limit, 2, is missed by so much at such an objective; nothing is admissible but in a last tile, at 9.
struct Missing {
  double objective, TV2_uw;
};
MemorySource missing(const std::vector<Missing>& tiles) {
  MemorySource source(line((tiles.size() + 1) * kTileSettings));
  for (std::uint64_t tile = 0; tile < tiles.size(); ++tile) {
    fill(source, Measure::IAE_w, tile, tiles[tile].objective);
    fill(source, Measure::TV2_uw, tile, tiles[tile].TV2_uw);
  }
  fill(source, Measure::IAE_w, tiles.size(), 9);
  return source;
}

TEST(Query, a_tile_that_cannot_win_counts_its_missing_objectives) {
  MemorySource source(line(2 * kTileSettings));
  fill(source, Measure::IAE_w, 1, 2);
  for (const std::uint64_t tile : {0, 1}) source.at(Measure::TV2_uw, (tile + 1) * kTileSettings - 1) = 5;
  source.at(Measure::IAE_w, kTileSettings) = kNaN;
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(numbers(answer), Numbers{0});
  EXPECT_EQ(answer.admissible, 2 * kTileSettings - 3);
  EXPECT_EQ(answer.left_out.objective_missing, 1u);
}

TEST(Query, what_threads_found_adds_up) {
  Selection all(2), other(2);
  all.admissible = 5, other.admissible = 3;
  all.best.offer({7, 2.0, Status::settled});
  other.best.offer({9, 1.0, Status::settled});
  other.best.offer({8, 3.0, Status::settled});
  other.waiting.emplace_back(0.5, 4);
  all.merge(other);
  EXPECT_EQ(all.admissible, 8u);
  EXPECT_EQ(all.waiting.size(), 1u);
  ASSERT_EQ(all.best.sorted().size(), 2u);
  EXPECT_EQ(all.best.sorted()[0].number, 9u);
  EXPECT_EQ(all.best.sorted()[1].number, 7u);
}

TEST(Query, a_price_reads_no_tile_that_fails_by_more_than_another) {
  MemorySource source = missing({{1, 2.5}, {5, 8}});
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].loosened->relative, 0.25);
  // The objective where all is admissible; the objective and TV2_uw of the first tile.
  EXPECT_EQ(source.values_read(), 3 * kTileSettings + 3 * kOfTheAnswer);
}

TEST(Query, a_price_finds_what_fails_by_less_in_a_later_tile) {
  const Answer answer = ask(missing({{1, 4}, {5, 3.25}}), question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.objective, 1);
  ASSERT_TRUE(answer.active[0].loosened);
  EXPECT_EQ(answer.active[0].loosened->found.number, kTileSettings);
  EXPECT_EQ(answer.active[0].loosened->relative, 0.625);
}

/// The second tile fails by as little as the first, and is better there; the first has the best of all elsewhere, at setting 7.
MemorySource missing_alike(double TV2_uw) {
  MemorySource source = missing({{5, TV2_uw}, {3, TV2_uw}});
  source.at(Measure::IAE_w, 7) = 1;
  source.at(Measure::TV2_uw, 7) = 4;
  return source;
}

TEST(Query, a_price_of_equal_violations_is_that_of_the_better_setting) {
  const MemorySource source = missing_alike(3);
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.number, 7u);
  EXPECT_EQ(answer.active[0].loosened->found.number, kTileSettings);
}

/// The same with a strict relation that both tiles miss by nothing at all.
TEST(Query, a_price_of_nothing_is_that_of_the_better_setting) {
  const MemorySource source = missing_alike(2);
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw < 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].loosened->found.number, kTileSettings);
  EXPECT_EQ(answer.active[0].loosened->relative, 0);
}

TEST(Query, a_price_reads_no_tile_for_a_constraint_when_another_fails_throughout) {
  MemorySource source = missing({{1, 2.5}, {5, 8}});
  source.at(Measure::IAE_d, kTileSettings) = 3;  // would be news about IAE_d, were it not for TV2_uw
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 2", "IAE_d <= 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  // The objective where all is admissible; objective, TV2_uw and IAE_d of the first tile.
  EXPECT_EQ(source.values_read(), 4 * kTileSettings + 3 * kOfTheAnswer);
}

TEST(Query, a_price_sees_infinite_sides_that_miss_by_nothing) {
  MemorySource source = missing({{1, 3}, {5, kInf}});
  source.at(Measure::IAE_d, kTileSettings) = kInf;  // inf < inf fails by 0, the others of the tile by inf
  fill(source, Measure::IAE_d, 0, 2);
  fill(source, Measure::IAE_d, 2, 2);
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw < IAE_d"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.number, 0u);
  EXPECT_EQ(answer.active[0].loosened->found.number, kTileSettings);
  EXPECT_EQ(answer.active[0].loosened->relative, 0);
}

TEST(Query, a_price_may_be_the_one_stable_setting_of_a_tile) {
  MemorySource source = missing({{5, 3}, {1, 4}});
  for (std::uint64_t i = 0; i < kTileSettings; ++i)
    if (i != 5) source.status(kTileSettings + i) = Status::unstable;
  const Answer answer = ask(source, question("IAE_w", {"TV2_uw <= 2"}));
  ASSERT_EQ(answer.active.size(), 1u);
  EXPECT_EQ(answer.active[0].optimum.number, kTileSettings + 5);
}

TEST(Query, refuses_a_question_that_does_not_fit) {
  const MemorySource source(line(5));
  const auto problem = [&](const Question& asked) { return error_text([&] { ask(source, asked); }); };
  EXPECT_EQ(problem(question("IAE_w", {}, 0)), "top must be 1 .. 100000 (it is 0)");
  EXPECT_EQ(problem(question("IAE_w", {}, 100'001)), "top must be 1 .. 100000 (it is 100001)");
  EXPECT_EQ(problem(question("IAE_w", {}, 100'000)), "no InputError");
  EXPECT_EQ(problem(question("Ms")),
            "--minimize:1:1: measure \"Ms\" is not stored in this portrait (stored: IAE_w, IAE_d, TV2_uw)\n  "
            "Ms\n  ^");
  EXPECT_EQ(problem(question("IAE_w", {"Mt < 2"})),
            "--where:1:1: measure \"Mt\" is not stored in this portrait (stored: IAE_w, IAE_d, TV2_uw)\n  Mt "
            "< 2\n  ^");
  EXPECT_EQ(problem(question("IAE_w", {"kappa == 0.55"})),
            "--where:1:1: the axis kappa has no value 0.55 (nearest: 0.5)\n  kappa == 0.55\n  ^");
}

}  // namespace
}  // namespace portrait
