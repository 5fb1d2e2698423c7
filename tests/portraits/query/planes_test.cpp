/// Cross-sections, clouds with their fronts, and the cache, against plain loops over every setting.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "portraits/query/cloud.h"
#include "portraits/query/column_cache.h"
#include "portraits/query/cross_section.h"
#include "tests/portraits/query/memory_source.h"

namespace portrait {
namespace {

/// 5 x 4 x 3 settings with whole numbers as measures, so that there are ties; some unstable, some not settled.
MemorySource portrait_of(unsigned seed) {
  Grid grid;
  grid.family = {Plant::dipdt, 0, Prefilter::pi};
  grid.measures = {Measure::IAE_w, Measure::IAE_d, Measure::Ms};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.5, 5), Axis::linear(Parameter::delta, 0.2, 0.8, 4),
               Axis::list(Parameter::tau_i, {4, 8, kInf})};
  grid.fixed = {{Parameter::b, 0}};
  MemorySource source(grid);
  std::mt19937 random(seed);
  for (std::uint64_t n = 0; n < setting_count(grid); ++n) {
    const auto roll = random() % 10;
    if (roll == 0) source.status(n) = Status::unstable;
    if (roll == 1) source.status(n) = Status::not_settled;
    for (const Measure m : grid.measures)
      source.at(m, n) = roll == 0 ? kNaN : static_cast<double>(1 + random() % 12);
  }
  return source;
}

Question question(bool include_not_settled = false) {
  return {parse_expression({"minimize", "IAE_w + IAE_d"}),
          {{parse_constraint({"where", "Ms <= 8"}), parse_constraint({"where", "kappa > 0.15"})},
           {},
           include_not_settled,
           1},
          1000,
          false};
}

TEST(CrossSection, HoldsTheSettingsOfItsPlaneWhateverTheAxes) {
  const MemorySource source = portrait_of(1);
  const Grid& grid = source.grid();
  const Expression sum = parse_expression({"colour", "IAE_w + 100*tau_d"});
  for (const auto& [x, y] :
       {std::pair{Parameter::kappa, Parameter::delta}, std::pair{Parameter::tau_i, Parameter::kappa},
        std::pair{Parameter::delta, Parameter::tau_i}}) {
    const CrossSection section(source, {}, x, y, {2, 3, 1});
    const std::vector<double> values = section.values(sum);
    for (std::size_t j = 0; j < section.ny(); ++j)
      for (std::size_t i = 0; i < section.nx(); ++i) {
        std::vector<std::uint64_t> at{2, 3, 1};
        at[axis_index(grid, x)] = i;
        at[axis_index(grid, y)] = j;
        const std::uint64_t number = (at[0] * 4 + at[1]) * 3 + at[2];
        const std::size_t k = j * section.nx() + i;
        EXPECT_EQ(section.numbers()[k], number);
        EXPECT_EQ(section.statuses()[k], source.status(number));
        const double wanted = source.at(Measure::IAE_w, number) + 100 * tau_d(setting_at(grid, number));
        EXPECT_EQ(std::isnan(values[k]), std::isnan(wanted));
        if (!std::isnan(wanted)) {
          EXPECT_NEAR(values[k], wanted, 1e-9);
        }
      }
  }
}

TEST(CrossSection, AdmissibleSettingsAreThoseOfTheQuery) {
  for (const unsigned seed : {1U, 2U, 3U})
    for (const bool include : {false, true}) {
      const MemorySource source = portrait_of(seed);
      const Question asked = question(include);
      std::vector<std::uint64_t> found, wanted;
      for (std::uint64_t k = 0; k < 3; ++k) {
        const CrossSection section(source, {}, Parameter::kappa, Parameter::delta, {0, 0, k});
        const auto admissible = section.admissible(asked);
        const auto violation = section.violation(asked);
        for (std::size_t i = 0; i < admissible.size(); ++i) {
          if (admissible[i]) found.push_back(section.numbers()[i]);
          EXPECT_FALSE(admissible[i] ? violation[i] > 0 : violation[i] < 0);
        }
      }
      for (const Found& f : ask(source, asked).top) wanted.push_back(f.number);
      std::sort(found.begin(), found.end());
      std::sort(wanted.begin(), wanted.end());
      EXPECT_EQ(found, wanted);
    }
}

TEST(Cloud, FrontIsThatOfEveryPairCompared) {
  const Expression x = parse_expression({"x", "IAE_w"}), y = parse_expression({"y", "Ms + IAE_d"});
  for (unsigned seed = 0; seed < 20; ++seed) {
    const MemorySource source = portrait_of(seed);
    const Question asked = question();
    const Cloud found = cloud(source, x, y, asked.conditions);
    std::vector<CloudPoint> all;
    for (const Found& f : ask(source, asked).top)
      all.push_back(
          {f.number, f.measures[Measure::IAE_w], f.measures[Measure::Ms] + f.measures[Measure::IAE_d], true});
    EXPECT_EQ(found.admissible, all.size());
    const auto better = [](const CloudPoint& a, const CloudPoint& b) {
      const bool equal = a.x == b.x && a.y == b.y;
      return a.x <= b.x && a.y <= b.y && (!equal || a.number < b.number);
    };
    std::vector<CloudPoint> front;
    for (const CloudPoint& p : all)
      if (std::none_of(all.begin(), all.end(),
                       [&](const CloudPoint& q) { return q.number != p.number && better(q, p); }))
        front.push_back(p);
    std::sort(front.begin(), front.end(), [](const CloudPoint& a, const CloudPoint& b) { return a.x < b.x; });
    ASSERT_EQ(found.front.size(), front.size()) << seed;
    for (std::size_t k = 0; k < front.size(); ++k) EXPECT_EQ(found.front[k].number, front[k].number) << seed;
  }
}

TEST(ColumnCache, GivesTheSameNumbersAndReadsEachColumnOnce) {
  const MemorySource source = portrait_of(4);
  const ColumnCache cache(source, 1 << 20);
  std::vector<double> a, b;
  std::vector<Status> s, t;
  for (int round = 0; round < 3; ++round)
    for (const Measure m : source.grid().measures)
      for (const std::uint64_t first : {0, 7, 59}) {
        source.read(m, first, 1, a);
        cache.read(m, first, 1, b);
        EXPECT_TRUE(a[0] == b[0] || (std::isnan(a[0]) && std::isnan(b[0])));
        source.read_statuses(first, 1, s);
        cache.read_statuses(first, 1, t);
        EXPECT_EQ(s, t);
      }
  EXPECT_EQ(source.values_read(), 3U * 3 * 3 + 3 * 60);  // ours, and each column whole once
}

TEST(ColumnCache, StaysWithinItsLimit) {
  const MemorySource source = portrait_of(5);
  const ColumnCache two(source, 2 * 60 * sizeof(double)), none(source, 100);
  std::vector<double> values;
  for (int round = 0; round < 4; ++round)
    for (const Measure m : source.grid().measures) {
      two.read(m, 0, 60, values);
      none.read(m, 3, 2, values);
      EXPECT_LE(two.held(), 2 * 60 * sizeof(double));
      EXPECT_EQ(none.held(), 0U);
    }
}

TEST(ColumnCache, ManyThreadsReadTheSame) {
  const MemorySource source = portrait_of(6);
  const ColumnCache cache(source, 2 * 60 * sizeof(double));
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      std::vector<double> values;
      for (int round = 0; round < 300; ++round) {
        const Measure m = source.grid().measures[static_cast<std::size_t>((round + k) % 3)];
        cache.read(m, 10, 20, values);
        for (std::uint64_t i = 0; i < 20; ++i)
          if (values[i] != source.at(m, 10 + i) && !std::isnan(source.at(m, 10 + i))) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace portrait
