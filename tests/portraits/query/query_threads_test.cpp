// One question on several threads, over a file that each of them reads: the answer is that of one thread. Its tiles are
// many enough that every thread has some (share gives each 64).
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "grids/tiling.h"
#include "portraits/query/column_cache.h"
#include "portraits/query/pareto.h"
#include "portraits/query/query.h"
#include "portraits/reader.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

constexpr int kThreads = 4;
constexpr const char* kFew = "TV2_uw <= 0.01";

/// Without an order in the setting's number, 0 to 1: every tile has something that the ranges do not rule out.
MeasureColumns scattered(const Grid& grid, std::uint64_t tile) {
  const Tiling tiling(grid);
  MeasureColumns columns(grid.measures, tiling.box(tile).size());
  for (std::size_t i = 0; i < columns.settings(); ++i) {
    MeasureRow row;
    for (const Measure measure : grid.measures) {
      std::uint64_t mixed = (tile * 4096 + i) * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(measure);
      mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9U;
      row[measure] = static_cast<double>(mixed >> 40) / (1 << 24);
    }
    columns.set(i, Status::settled, row);
  }
  return columns;
}

class QueryThreads : public ScratchTest {
 protected:
  void SetUp() override {
    ScratchTest::SetUp();
    sample::write(in("p.h5"), sample::grid_of({160, 5200}), Existing::refuse, scattered);
  }

  static Conditions conditions(int threads, const std::string& where) {
    return {{parse_constraint({"where", where})}, {}, false, threads};
  }
  static Answer answer(const ColumnSource& source, int threads, const std::string& where) {
    return ask(source, {parse_expression({"minimize", "IAE_w + Ms"}), conditions(threads, where), 20, true});
  }
};

void expect_same(const Answer& a, const Answer& b) {
  EXPECT_EQ(a.admissible, b.admissible);
  EXPECT_EQ(a.excluded, b.excluded);
  EXPECT_EQ(a.active.size(), b.active.size());
  EXPECT_EQ(a.near_miss.has_value(), b.near_miss.has_value());
  if (a.near_miss && b.near_miss) {
    EXPECT_EQ(a.near_miss->found.number, b.near_miss->found.number);
  }
  ASSERT_EQ(a.top.size(), b.top.size());
  for (std::size_t k = 0; k < a.top.size(); ++k) EXPECT_EQ(a.top[k].number, b.top[k].number) << k;
}

TEST_F(QueryThreads, AskTheSameOfAFile) {
  const PortraitReader portrait(in("p.h5"));
  for (const std::string where : {kFew, "TV2_uw < -1"}) {
    const Answer alone = answer(portrait, 1, where);
    EXPECT_EQ(alone.admissible > 0, where == kFew);
    expect_same(answer(portrait, kThreads, where), alone);
  }
}

TEST_F(QueryThreads, FindTheSameFront) {
  const PortraitReader portrait(in("p.h5"));
  const auto front = [&](int threads) {
    std::vector<std::uint64_t> numbers;
    const ParetoQuestion question{{parse_expression({"a", "IAE_w"}), parse_expression({"b", "Ms"})},
                                  conditions(threads, kFew),
                                  12};
    for (const FrontPoint& point : pareto(portrait, question).front) numbers.push_back(point.number);
    return numbers;
  };
  const std::vector<std::uint64_t> alone = front(1);
  EXPECT_GT(alone.size(), 1U);
  EXPECT_EQ(front(kThreads), alone);
}

TEST_F(QueryThreads, AskOneCacheTogether) {
  const PortraitReader portrait(in("p.h5"));
  const Answer alone = answer(portrait, 1, kFew);
  const ColumnCache cache(portrait, 30'000'000);  // all three columns, which each asks for first
  std::vector<Answer> answers(3);
  std::vector<std::thread> threads;
  for (Answer& one : answers) threads.emplace_back([&] { one = answer(cache, 2, kFew); });
  for (std::thread& thread : threads) thread.join();
  for (const Answer& one : answers) expect_same(one, alone);
}

TEST_F(QueryThreads, VerifyTheSame) {
  const auto digests = [&](int threads) {
    std::vector<std::string> all;
    for (const CheckedDataset& set : verify(in("p.h5"), threads).datasets) all.push_back(set.name + set.digest);
    return all;
  };
  EXPECT_EQ(digests(kThreads), digests(1));
}

}  // namespace
}  // namespace portrait
