#include "engine/rules/half_rule.h"

#include <numeric>

#include <gtest/gtest.h>

namespace portrait::rules {
namespace {

double sum(const FewLags& few) { return std::accumulate(few.lags.begin(), few.lags.end(), few.dead_time); }

TEST(HalfRule, FourEqualLags) {  // Huba2021 (85), (86), (89)-(91)
  const std::vector<double> four(4, 1.0);
  EXPECT_EQ(half_rule(four, 0, 1).lags, (std::vector<double>{1.5}));
  EXPECT_EQ(half_rule(four, 0, 1).dead_time, 2.5);
  EXPECT_EQ(half_rule(four, 0, 2).lags, (std::vector<double>{1.5, 1}));
  EXPECT_EQ(half_rule(four, 0, 2).dead_time, 1.5);
  EXPECT_EQ(modified_half_rule(four, 0, 1).lags, (std::vector<double>{2.5}));
  EXPECT_EQ(modified_half_rule(four, 0, 2).lags, (std::vector<double>{1.5, 1.5}));
  EXPECT_NEAR(modified_half_rule(four, 0, 3).lags[0], 3.5 / 3, 1e-15);
  EXPECT_EQ(modified_half_rule(four, 0, 3).dead_time, 0.5);
}

TEST(HalfRule, BothKeepTheAverageResidenceTime) {
  const std::vector<double> lags{0.1, 5, 0.7, 2, 0.3};
  for (std::size_t kept = 1; kept <= 5; ++kept) {
    EXPECT_NEAR(sum(half_rule(lags, 0.4, kept)), 8.5, 1e-14);
    EXPECT_NEAR(sum(modified_half_rule(lags, 0.4, kept)), 8.5, 1e-14);
  }
}

}  // namespace
}  // namespace portrait::rules
