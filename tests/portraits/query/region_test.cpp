/// A setting on the grid or not against the conditions, as the engine measures it.
#include "portraits/query/region.h"

#include <gtest/gtest.h>

#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/ipdt_over_kappa.h"

namespace portrait {
namespace {

Grid ipdt(double horizon) { return ipdt_over_kappa(horizon, {Measure::IAE_d, Measure::Ms}); }

Conditions conditions(const std::vector<std::string>& where, bool include_not_settled = false) {
  Conditions all;
  for (const std::string& text : where) all.where.push_back(parse_constraint({"", text}));
  all.include_not_settled = include_not_settled;
  return all;
}

TEST(Judge, says_of_each_constraint_how_its_sides_stand) {
  const Verdict found = judge(ipdt(80), conditions({"Ms <= 1", "IAE_d < inf", "kappa >= 0.33"}), with_kappa(0.33));
  const double Ms = found.measured.measures[Measure::Ms];
  ASSERT_EQ(found.constraints.size(), 3u);
  EXPECT_EQ(found.constraints[0].left, Ms);
  EXPECT_EQ(found.constraints[0].right, 1);
  EXPECT_FALSE(found.constraints[0].holds);
  EXPECT_DOUBLE_EQ(found.constraints[0].relative, Ms - 1);
  EXPECT_TRUE(found.constraints[1].holds);
  EXPECT_TRUE(found.constraints[2].holds);
  EXPECT_EQ(found.constraints[2].relative, 0);
  EXPECT_TRUE(found.right_status);
  EXPECT_FALSE(found.admissible());
  EXPECT_TRUE(judge(ipdt(80), conditions({"Ms <= 3", "IAE_d < inf"}), with_kappa(0.33)).admissible());
  EXPECT_TRUE(judge(ipdt(80), conditions({}), with_kappa(0.33)).admissible());
}

TEST(Judge, wants_a_settled_loop_or_at_least_a_stable_one) {
  for (const bool include : {false, true}) {
    const Verdict late = judge(ipdt(4), conditions({"Ms < inf"}, include), with_kappa(0.33));
    EXPECT_EQ(late.measured.status, Status::not_settled);
    EXPECT_EQ(late.right_status, include);
    EXPECT_EQ(late.admissible(), include);
    EXPECT_TRUE(judge(ipdt(80), conditions({}, include), with_kappa(0.33)).right_status);
    EXPECT_FALSE(judge(ipdt(80), conditions({}, include), with_kappa(3)).right_status);
  }
}

TEST(Judge, refuses_conditions_that_do_not_fit) {
  EXPECT_THROW(judge(ipdt(80), conditions({"IAE_w < 3"}), with_kappa(0.33)), InputError);
}

}  // namespace
}  // namespace portrait
