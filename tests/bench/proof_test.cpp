#include "bench/proof.h"

#include <limits>

#include <gtest/gtest.h>

namespace portrait::bench {
namespace {

const Loop kLoop = {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.125, .tau_i = 10, .delta = 0.5, .tau_f = 0.1}};
const std::vector<Measure> kMeasures = {Measure::IAE_w, Measure::TV_uw, Measure::TV2_uw, Measure::y_max_d,
                                        Measure::Ms};

MeasureRow truth() {
  MeasureRow row;
  row[Measure::IAE_w] = 10, row[Measure::TV_uw] = 2, row[Measure::TV2_uw] = 1e-3;
  row[Measure::TV_yd] = 16, row[Measure::y_max_d] = 8, row[Measure::Ms] = 2;
  return row;
}

double prove_with(Measure m, double value) {
  MeasureRow found = truth();
  found[m] = value;
  return prove("case/code", kLoop, kMeasures, found, truth(), {1e-8, 1e-7});
}

std::string complaint(Measure m, double value) {
  try {
    prove_with(m, value);
  } catch (const WrongAnswer& wrong) {
    return wrong.what();
  }
  return "none";
}

TEST(Proof, AcceptsWhatIsWithinItsTolerance) {
  EXPECT_EQ(prove_with(Measure::IAE_w, 10), 0);
  EXPECT_NEAR(prove_with(Measure::IAE_w, 10 + 9e-8), 9e-9, 1e-15);
  EXPECT_NEAR(prove_with(Measure::Ms, 2 - 1.8e-8), 9e-9, 1e-15);
  // Of the signal's total variation, not of the measure.
  EXPECT_NEAR(prove_with(Measure::TV2_uw, 1e-3 + 1.8e-7), 9e-8, 1e-15);
  EXPECT_NEAR(prove_with(Measure::y_max_d, 8 + 1.4e-6), 8.75e-8, 1e-15);
}

TEST(Proof, RefusesAWrongAnswerAndSaysHowToSeeTheRightOne) {
  EXPECT_EQ(
      complaint(Measure::IAE_w, 10.5),
      "case/code: IAE_w is 10.5, the reference says 10: off by 5.0e-02, allowed 1e-08\n"
      "reproduce: portrait simulate --plant dipdt --n 1 --prefilter full --kappa 0.125 --tau-i 10 --delta 0.5 "
      "--tau-f 0.1 --b 0 --c 0");
  EXPECT_NE(complaint(Measure::IAE_w, 10 + 1.1e-7), "none");
  EXPECT_NE(complaint(Measure::Ms, 2 - 2.2e-8), "none");
  EXPECT_NE(complaint(Measure::TV2_uw, 1e-3 + 2.2e-7), "none");
  EXPECT_NE(complaint(Measure::y_max_d, 8 + 1.8e-6), "none");
}

TEST(Proof, RefusesWhatIsNoNumber) {
  EXPECT_NE(complaint(Measure::TV_uw, std::numeric_limits<double>::quiet_NaN()), "none");
  EXPECT_NE(complaint(Measure::TV_uw, std::numeric_limits<double>::infinity()), "none");
}

TEST(Proof, RefusesACaseThatTheStepLoopDoesNotResolve) {
  Case fast = few_of_each(cases())[1];
  ASSERT_EQ(fast.name, "dipdt-pid-fast");
  EXPECT_NO_THROW(prove_answers(fast));
  fast.batched_tolerance = 1e-4;
  EXPECT_THROW(prove_answers(fast), WrongAnswer);
}

}  // namespace
}  // namespace portrait::bench
