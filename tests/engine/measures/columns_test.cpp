#include "engine/measures/columns.h"

#include <cmath>

#include <gtest/gtest.h>

namespace portrait {
namespace {

TEST(MeasureColumns, HoldWhatWasSetAndNaNElsewhere) {
  MeasureColumns columns({Measure::IAE_d, Measure::Ms, Measure::TV3_uw}, 3);
  ASSERT_EQ(columns.settings(), 3U);
  ASSERT_EQ(columns.values.size(), 3U);
  MeasureRow row;
  row[Measure::IAE_w] = 1;
  row[Measure::IAE_d] = 2;
  row[Measure::TV3_uw] = 3;
  columns.set(1, Status::not_settled, row);
  EXPECT_EQ(columns.values[0][1], 2);
  EXPECT_TRUE(std::isnan(columns.values[1][1]));
  EXPECT_EQ(columns.values[2][1], 3);
  EXPECT_EQ(columns.status[1], Status::not_settled);
  for (const std::size_t other : {0, 2}) {
    EXPECT_EQ(columns.status[other], Status::not_computed);
    for (const auto& column : columns.values) EXPECT_TRUE(std::isnan(column[other]));
  }
}

TEST(MeasureColumns, ARunOfOutcomesIsWhatEachGivesAlone) {
  struct Outcome {
    Status status = Status::settled;
    MeasureRow measures;
  };
  std::vector<Outcome> outcomes(37);  // more than twice what is set at once
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (i % 5 == 0) outcomes[i].status = Status::unstable;
    outcomes[i].measures[Measure::IAE_d] = static_cast<double>(i),
    outcomes[i].measures[Measure::Ms] = 100.0 + static_cast<double>(i);
  }
  MeasureColumns run({Measure::IAE_d, Measure::Ms}, 40), each = run;
  run.set_all(2, std::span<const Outcome>(outcomes));
  for (std::size_t i = 0; i < outcomes.size(); ++i) each.set(2 + i, outcomes[i].status, outcomes[i].measures);
  EXPECT_EQ(run.status, each.status);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < 40; ++i)
      EXPECT_TRUE(run.values[k][i] == each.values[k][i] || (i < 2 || i == 39)) << k << " " << i;
  EXPECT_TRUE(std::isnan(run.values[0][1]) && std::isnan(run.values[1][39]));
}

}  // namespace
}  // namespace portrait
