#include "bench/results.h"

#include <gtest/gtest.h>

namespace portrait::bench {
namespace {

TEST(Results, MedianSpreadAndRatioOfMedians) {
  Results results;
  for (const double rate : {30.0, 10.0, 20.0}) results.add("odd", rate);
  for (const double rate : {1.0, 9.0, 4.0, 6.0}) results.add("even", rate);
  EXPECT_EQ(results.median("odd"), 20);
  EXPECT_EQ(results.median("even"), 5);
  EXPECT_EQ(results.spread("odd"), 1);
  EXPECT_EQ(results.ratio("odd", "even"), 4);
  EXPECT_EQ(results.ratio("odd", "none"), std::nullopt);
  EXPECT_EQ(results.ratio("none", "odd"), std::nullopt);
}

}  // namespace
}  // namespace portrait::bench
