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

}  // namespace
}  // namespace portrait
