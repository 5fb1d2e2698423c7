/// Every kind of answer from two threads that both had tiles to read, against that of one: what each found is joined without
/// loss. A source makes the two wait for each other at their first read; nothing is known of tiles, so that all are read.
#include <condition_variable>
#include <memory>
#include <mutex>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "portraits/query/pareto.h"
#include "portraits/query/region.h"
#include "portraits/query/trade_off.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/small_portraits.h"

namespace portrait {
namespace {

class Meeting {
 public:
  void arrive() {
    std::unique_lock lock(mutex_);
    ++arrived_;
    all_here_.notify_all();
    all_here_.wait(lock, [&] { return arrived_ >= 2; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable all_here_;
  int arrived_ = 0;
};

/// One thread's: its first read after another thread got its own waits for the other's.
class MeetingSource final : public ColumnSource {
 public:
  explicit MeetingSource(const MemorySource& source, std::shared_ptr<Meeting> meeting = nullptr)
      : source_(source), meeting_(std::move(meeting)) {}
  const Grid& grid() const override { return source_.grid(); }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override {
    source_.read(measure, first, count, values);
  }
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override {
    if (meeting_ && count > 1) meeting_->arrive();
    if (count > 1) meeting_ = nullptr;
    source_.read_statuses(first, count, statuses);
  }
  std::unique_ptr<ColumnSource> for_another_thread() const override {
    meeting_ = std::make_shared<Meeting>();
    return std::make_unique<MeetingSource>(source_, meeting_);
  }

 private:
  const MemorySource& source_;
  mutable std::shared_ptr<Meeting> meeting_;
};

class TwoThreads : public ::testing::Test {
 protected:
  /// 80 tiles, so that there is work for two threads.
  static MemorySource scattered() {
    Grid grid = line(2);
    grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.9, 80), Axis::linear(Parameter::tau_i, 2, 20, 4000)};
    grid.fixed = {{Parameter::delta, 0.5}};
    MemorySource source(grid);
    std::mt19937 random(5);
    for (std::uint64_t i = 0; i < setting_count(grid); ++i) {
      source.status(i) = static_cast<Status>(random() % 4);
      for (const Measure measure : grid.measures)
        source.at(measure, i) = random() % 50 == 0 ? kNaN : static_cast<double>(random() % 1'000'000);
    }
    for (std::uint64_t i = 0; i < setting_count(grid); i += 4000) {  // both threads have some of the first tau_i
      source.status(i) = Status::settled;
      source.at(Measure::TV2_uw, i) = source.at(Measure::IAE_d, i) = 2;
    }
    source.know_summaries(false);
    return source;
  }

  MeetingSource meeting() const { return MeetingSource(source_); }

  static Question asked(int threads, const std::vector<std::string>& where) {
    Question one = question("IAE_w", where, 40);
    one.conditions.threads = threads;
    one.count_excluded = true;
    return one;
  }

  static void expect_same(const LeftOut& a, const LeftOut& b) {
    EXPECT_EQ(a.unstable, b.unstable);
    EXPECT_EQ(a.not_settled, b.not_settled);
    EXPECT_EQ(a.not_computed, b.not_computed);
    EXPECT_EQ(a.objective_missing, b.objective_missing);
  }

  const std::vector<std::string> few_ = {"TV2_uw <= 10000", "IAE_d <= 500000"};
  const std::vector<std::string> none_ = {"TV2_uw <= -1", "IAE_d <= 1"};
  const MemorySource source_ = scattered();
};

TEST_F(TwoThreads, count_and_rank_as_one) {
  for (const auto& where : {few_, none_}) {
    const Answer a = ask(meeting(), asked(2, where)), b = ask(source_, asked(1, where));
    EXPECT_EQ(b.top.empty(), where == none_);
    EXPECT_EQ(numbers(a), numbers(b));
    EXPECT_EQ(a.admissible, b.admissible);
    EXPECT_EQ(a.total, b.total);
    expect_same(a.left_out, b.left_out);
    EXPECT_EQ(a.excluded, b.excluded);
    ASSERT_EQ(a.active.size(), b.active.size());
    for (std::size_t j = 0; j < a.active.size(); ++j) {
      EXPECT_EQ(a.active[j].optimum.number, b.active[j].optimum.number);
      EXPECT_EQ(a.active[j].loosened->found.number, b.active[j].loosened->found.number);
    }
    EXPECT_EQ(b.active.empty(), where == none_);
    ASSERT_EQ(a.near_miss.has_value(), where == none_);
    if (a.near_miss) {
      EXPECT_EQ(a.near_miss->found.number, b.near_miss->found.number);
    }
  }
}

TEST_F(TwoThreads, outline_the_region_of_one) {
  const Region a = region(meeting(), asked(2, few_).conditions), b = region(source_, asked(1, few_).conditions);
  EXPECT_GT(b.admissible, 100u);
  EXPECT_EQ(a.admissible, b.admissible);
  EXPECT_EQ(a.total, b.total);
  expect_same(a.left_out, b.left_out);
  ASSERT_EQ(a.axes.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(a.axes[k].counts, b.axes[k].counts);
  EXPECT_EQ(a.correlation, b.correlation);
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t k = 0; k < a.pieces.size(); ++k) {
    EXPECT_EQ(a.pieces[k].lowest, b.pieces[k].lowest);
    EXPECT_EQ(a.pieces[k].settings, b.pieces[k].settings);
  }
}

TEST_F(TwoThreads, draw_the_front_of_one) {
  const auto front = [&](const ColumnSource& source, int threads) {
    return pareto(source, {{parse_expression({"", "IAE_w"}), parse_expression({"", "TV2_uw"})},
                           asked(threads, {"IAE_d <= 500000"}).conditions});
  };
  const ParetoAnswer a = front(meeting(), 2), b = front(source_, 1);
  EXPECT_GT(b.front.size(), 3u);
  EXPECT_EQ(a.admissible, b.admissible);
  EXPECT_EQ(a.total, b.total);
  expect_same(a.left_out, b.left_out);
  ASSERT_EQ(a.front.size(), b.front.size());
  for (std::size_t k = 0; k < a.front.size(); ++k) EXPECT_EQ(a.front[k].number, b.front[k].number);
}

/// Wherever the best lies: the thread that finds it must be heard.
TEST_F(TwoThreads, find_what_is_nearest_and_best_as_one) {
  for (const std::uint64_t at : {std::uint64_t{3}, setting_count(source_.grid()) - 5}) {
    const Setting from = setting_at(source_.grid(), at);
    const auto a = nearest_admissible(meeting(), asked(2, few_).conditions, from);
    const auto b = nearest_admissible(source_, asked(1, few_).conditions, from);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->found.number, b->found.number);
  }
  const Expression along = parse_expression({"", "IAE_d"});
  const std::vector<double> bounds = {1e4, 1e5, 5e5, 9e5};
  const auto a = trade_off(meeting(), asked(2, few_), along, bounds);
  const auto b = trade_off(source_, asked(1, few_), along, bounds);
  for (std::size_t k = 0; k < bounds.size(); ++k) {
    ASSERT_EQ(a[k].best.has_value(), b[k].best.has_value());
    if (b[k].best) {
      EXPECT_EQ(a[k].best->number, b[k].best->number);
    }
  }
  EXPECT_TRUE(b.back().best);
}

}  // namespace
}  // namespace portrait
