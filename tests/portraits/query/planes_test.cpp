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

TEST(CrossSection, ReadsWhatLiesTogetherAtOnce) {
  const MemorySource source = portrait_of(1);
  const CrossSection section(source, {}, Parameter::tau_i, Parameter::delta, {2, 0, 0});
  section.values(parse_expression({"", "IAE_w"}));
  EXPECT_EQ(source.longest_read(), 12U);  // 4 x 3 settings of one kappa
  EXPECT_EQ(source.values_read(), 12U);
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

TEST(CrossSection, TheViolationIsTheWorstRelativeExcess) {
  MemorySource source = portrait_of(2);
  source.at(Measure::Ms, 4) = kNaN;
  source.at(Measure::IAE_d, 5) = kNaN;
  source.status(4) = source.status(5) = Status::settled;
  Question asked = question();
  for (const char* text : {"IAE_w >= 5", "Ms < 2*IAE_d", "IAE_d == 3"})
    asked.conditions.where.push_back(parse_constraint({"where", text}));
  for (std::uint64_t k = 0; k < 3; ++k) {
    const CrossSection section(source, {}, Parameter::kappa, Parameter::delta, {0, 0, k});
    const std::vector<double> found = section.violation(asked);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::uint64_t n = section.numbers()[i];
      const double Ms = source.at(Measure::Ms, n), IAE_w = source.at(Measure::IAE_w, n),
                   IAE_d = source.at(Measure::IAE_d, n), kappa = setting_at(source.grid(), n).kappa;
      const bool exists = source.status(n) == Status::settled && !std::isnan(Ms + IAE_w + IAE_d);
      EXPECT_EQ(std::isnan(found[i]), !exists);
      if (exists) {
        EXPECT_DOUBLE_EQ(found[i], std::max({(Ms - 8) / 8, (0.15 - kappa) / 0.15, (5 - IAE_w) / 5,
                                             (Ms - 2 * IAE_d) / (2 * IAE_d)}));
      }
    }
  }
}

TEST(CrossSection, MeasuresAndControllersAreInTheQuestionsUnits) {
  const MemorySource source = portrait_of(3);
  const RealPlant plant{Plant::dipdt, -2, 3, 0};
  const CrossSection section(source, {plant, {2, 1}}, Parameter::kappa, Parameter::delta, {0, 0, 1});
  const std::vector<double> sums = section.values(parse_expression({"", "IAE_w"}));
  const std::vector<double> gains = section.values(parse_expression({"", "Kc"}));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::uint64_t n = section.numbers()[i];
    if (source.status(n) != Status::unstable) {
      EXPECT_EQ(sums[i], source.at(Measure::IAE_w, n) * 3 * 2);  // times Td and the step
    }
    EXPECT_DOUBLE_EQ(gains[i], setting_at(source.grid(), n).kappa / -18);
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

TEST(Cloud, HoldsEveryEligibleSetting) {
  const Expression x = parse_expression({"x", "IAE_w"}), y = parse_expression({"y", "Ms + IAE_d"});
  for (const bool include : {false, true}) {
    MemorySource source = portrait_of(3);
    source.at(Measure::IAE_w, 7) = kInf;
    source.at(Measure::Ms, 8) = kNaN;
    const Question asked = question(include);
    const Cloud found = cloud(source, x, y, asked.conditions);
    std::size_t next = 0;
    for (std::uint64_t n = 0; n < 60; ++n) {
      const double at_x = source.at(Measure::IAE_w, n), Ms = source.at(Measure::Ms, n),
                   at_y = Ms + source.at(Measure::IAE_d, n);
      const Status status = source.status(n);
      const bool eligible = status == Status::settled || (include && status == Status::not_settled);
      if (!eligible || !std::isfinite(at_x) || !std::isfinite(at_y)) continue;
      ASSERT_LT(next, found.points.size());
      const CloudPoint& p = found.points[next++];
      EXPECT_EQ(p.number, n);
      EXPECT_EQ(p.x, at_x);
      EXPECT_EQ(p.y, at_y);
      EXPECT_EQ(p.admissible, Ms <= 8 && setting_at(source.grid(), n).kappa > 0.15);
    }
    EXPECT_EQ(next, found.points.size());
  }
}

TEST(Cloud, KeepsEveryKthOfMoreSettingsThanItShows) {
  for (const auto& [settings, every] : {std::pair<std::uint64_t, std::uint64_t>{kMostPoints, 1},
                                        {kMostPoints + 1, 2},
                                        {2 * kMostPoints, 2},
                                        {2 * kMostPoints + 1, 3}}) {
    Grid grid;
    grid.family = {Plant::ipdt, 0, Prefilter::none};
    grid.measures = {Measure::IAE_w};
    grid.axes = {Axis::linear(Parameter::kappa, 0.1, 1, settings)};
    grid.fixed = {{Parameter::tau_i, 8}, {Parameter::delta, 0}};
    const Expression one = parse_expression({"", "IAE_w"});
    const Cloud found = cloud(MemorySource(grid), one, parse_expression({"", "kappa"}), {});
    ASSERT_EQ(found.points.size(), (settings + every - 1) / every);
    for (std::size_t i = 0; i < found.points.size(); ++i) ASSERT_EQ(found.points[i].number, i * every);
    EXPECT_EQ(found.admissible, settings);
  }
}

TEST(Cloud, ReadsNoTileWithoutEligibleSettings) {
  Grid grid;
  grid.family = {Plant::ipdt, 0, Prefilter::none};
  grid.measures = {Measure::IAE_w};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 1, 2 * kTileSettings)};
  grid.fixed = {{Parameter::tau_i, 8}, {Parameter::delta, 0}};
  MemorySource source(grid);
  for (std::uint64_t n = 0; n < kTileSettings; ++n) source.status(n) = Status::unstable;
  const Cloud found = cloud(source, parse_expression({"", "IAE_w"}), parse_expression({"", "kappa"}), {});
  EXPECT_EQ(found.admissible, kTileSettings);
  EXPECT_EQ(source.values_read(), kTileSettings);
}

TEST(Cloud, AnExpressionAtASettingIsThatOfItsNumbers) {
  MeasureRow row;
  row[Measure::IAE_w] = 5;
  const Setting setting{.kappa = 0.3, .tau_i = 8, .delta = 0.6};
  const QueryUnits units{RealPlant{Plant::ipdt, 2, 0.5, 0}, {}};
  EXPECT_DOUBLE_EQ(value_at(parse_expression({"", "IAE_w + 10*kappa + tau_d"}), setting, row, units), 5 + 3 + 2);
  EXPECT_DOUBLE_EQ(value_at(parse_expression({"", "Kc"}), setting, row, units), 0.3 / (2 * 0.5));
  EXPECT_TRUE(std::isnan(value_at(parse_expression({"", "Ms"}), setting, row, units)));
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

TEST(ColumnCache, AnswersAsItsSourceAgainAndAgain) {
  const MemorySource source = portrait_of(7);
  const ColumnCache cache(source, 1 << 20);
  const Question asked = question();
  const Answer expected = ask(source, asked);
  ASSERT_GT(expected.top.size(), 3U);
  for (int round = 0; round < 2; ++round) {
    const Answer answer = ask(cache, asked);
    ASSERT_EQ(answer.top.size(), expected.top.size());
    for (std::size_t i = 0; i < answer.top.size(); ++i) EXPECT_EQ(answer.top[i].number, expected.top[i].number);
  }
}

TEST(ColumnCache, HoldsAsMuchAsItsLimitTakes) {
  const MemorySource source = portrait_of(5);
  constexpr std::size_t kColumn = 60 * sizeof(double), kStatuses = 60 * sizeof(Status);
  for (const auto& [limit, columns] : {std::pair<std::size_t, std::size_t>{kColumn + kStatuses - 1, 0},
                                       {kColumn + kStatuses, 1},
                                       {2 * kColumn + kStatuses - 1, 1},
                                       {2 * kColumn + kStatuses, 2},
                                       {3 * kColumn + kStatuses, 3}}) {
    const ColumnCache cache(source, limit);
    std::vector<double> values;
    std::vector<Status> statuses;
    for (int round = 0; round < 4; ++round)
      for (std::size_t k = 0; k < 3; ++k) {
        cache.read(source.grid().measures[k], 3, 2, values);
        EXPECT_EQ(values.size(), 2U);
        EXPECT_EQ(cache.held(),
                  std::min(round == 0 ? k + 1 : 3, columns) * kColumn + (round > 0 && columns > 0 ? kStatuses : 0));
        if (k == 2) cache.read_statuses(3, 2, statuses);
        EXPECT_LE(cache.held(), limit);
      }
  }
}

TEST(ColumnCache, ManyThreadsReadTheSame) {
  const MemorySource source = portrait_of(6);
  const ColumnCache cache(source, 60 * (2 * sizeof(double) + sizeof(Status)));
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
