#include "reproduce/verdict.h"

#include <cmath>

#include <gtest/gtest.h>

namespace portrait::reproduce {
namespace {

PublishedTable one(const std::string& number, double within = 0) {
  PublishedTable t;
  t.columns = {"x"};
  t.rows = {{"r", {number}}};
  t.within = within, t.within_why = "sampled";
  t.notes = {{{}, {}, "use the other plant", ""}, {{"r"}, {"x"}, "", "misprint"}};
  return t;
}

TEST(Verdict, AgreesToPrintedDigits) {
  EXPECT_EQ(compared(one("0.125"), 0, 0, {0.12549, {}}).verdict, Verdict::agrees);
  EXPECT_FALSE(compared(one("0.125"), 0, 0, {0.12549, {}}).last_digit);
  EXPECT_TRUE(compared(one("0.125"), 0, 0, {0.1259, {}}).last_digit);
  EXPECT_EQ(compared(one("0.125"), 0, 0, {0.1262, {}}).verdict, Verdict::differs);
  EXPECT_EQ(compared(one("0.125"), 0, 0, {0.1262, {}}).why, "misprint");
  EXPECT_NEAR(compared(one("0.125"), 0, 0, {0.1262, {}}).difference, 0.0012, 1e-15);
}

TEST(Verdict, ACorrectionMustMakeItAgree) {
  const Compared corrected = compared(one("0.125"), 0, 0, {0.3, 0.1251});
  EXPECT_EQ(corrected.verdict, Verdict::corrected);
  EXPECT_EQ(corrected.ours, 0.1251);
  EXPECT_EQ(corrected.why, "use the other plant");
  EXPECT_EQ(compared(one("0.125"), 0, 0, {0.3, 0.2}).verdict, Verdict::differs);
  EXPECT_EQ(compared(one("0.125"), 0, 0, {0.125, 0.2}).verdict, Verdict::agrees);
}

TEST(Verdict, AnAllowanceIsRelativeAndGivesItsReason) {
  EXPECT_EQ(compared(one("100.0", 0.01), 0, 0, {100.9, {}}).why, "sampled");
  EXPECT_EQ(compared(one("100.0", 0.01), 0, 0, {101.2, {}}).verdict, Verdict::differs);
  EXPECT_EQ(compared(one("100.0"), 0, 0, {std::nan(""), {}}).verdict, Verdict::differs);
}

}  // namespace
}  // namespace portrait::reproduce
