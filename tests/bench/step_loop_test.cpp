// The baselines: every instruction set, one setting at a time and many, gives the same.
#include <cmath>

#include <gtest/gtest.h>

#include "bench/codes.h"

namespace portrait::bench {
namespace {

std::vector<BothSteps> run(const Baseline& baseline, bool batched, const Case& of, std::size_t count) {
  const std::vector<StepSetting> settings = for_step_loop(std::span(of.settings).first(count));
  const StepTask task{static_cast<StepPlant>(of.grid.family.plant), of.settings[0].delta > 0, 50, 51};
  constexpr std::size_t kBeyond = 16;
  const StepMeasures untouched = {-1, -1, -1};
  std::vector<BothSteps> results(count + kBeyond, {untouched, untouched});
  (batched ? baseline.batched : baseline.scalar)(task, settings.data(), static_cast<int>(count), results.data());
  for (std::size_t i = count; i < results.size(); ++i)
    EXPECT_EQ(results[i].d.tv_u, -1) << "written beyond the last";
  results.resize(count);
  return results;
}

double difference(const StepMeasures& a, const StepMeasures& b) {
  return std::max(
      {std::abs(a.iae - b.iae) / b.iae, std::abs(a.tv_y - b.tv_y) / b.tv_y, std::abs(a.tv_u - b.tv_u) / b.tv_u});
}

TEST(StepLoop, SameOnEveryInstructionSetScalarAndBatched) {
  for (const Case& of : few_of_each(cases())) {
    const std::vector<BothSteps> expected = run(*available_baselines().front(), false, of, 33);
    for (const Baseline* baseline : available_baselines())
      for (const bool batched : {false, true}) {
        SCOPED_TRACE(of.name + " " + baseline->name + (batched ? " batched" : " scalar"));
        const std::vector<BothSteps> found = run(*baseline, batched, of, 33);
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_LT(difference(found[i].w, expected[i].w), 1e-11);
          EXPECT_LT(difference(found[i].d, expected[i].d), 1e-11);
        }
      }
  }
}

/// 33 settings leave a pack that is not full; so do 1, 2, 3, ...
TEST(StepLoop, APackNeedNotBeFull) {
  const Case of = few_of_each(cases()).front();
  const Baseline& baseline = *available_baselines().back();
  const std::vector<BothSteps> all = run(baseline, true, of, 33);
  for (std::size_t count = 1; count <= 9; ++count) {
    const std::vector<BothSteps> found = run(baseline, true, of, count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(found[i].w.iae, all[i].w.iae);
  }
}

TEST(FmaPeak, CountsItsOperations) {
  for (const Baseline* baseline : available_baselines())
    EXPECT_EQ(baseline->multiply_and_add(1000), 2.0 * 12 * baseline->lanes * 1000) << baseline->name;
}

}  // namespace
}  // namespace portrait::bench
