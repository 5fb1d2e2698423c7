// The corners of the domain: kernel and reference against independent means.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "engine/loop/parameters.h"
#include "tests/audit/comparison.h"

namespace portrait::audit {
namespace {

struct Corner {
  std::string name;
  Loop loop;
  int dead_times = 20;
};

/// Just inside of kappa = pi/2, where u = -kappa y(t - 1) has its roots on the axis.
const double kLimit = std::numbers::pi / 2;

const std::vector<Corner> kCorners = {
    {"TinyFilter", {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.1248, .tau_i = 10.3, .delta = 0.5, .tau_f = 1e-3}}, 12},
    {"TinyFilterOfOrderFour", {{Plant::ipdt, 4, Prefilter::none}, {.kappa = 0.4, .tau_i = 6, .delta = 0.1, .tau_f = 1e-3}}, 12},
    {"VerySlowFilter", {{Plant::ipdt, 1, Prefilter::none}, {.kappa = 0.002, .tau_f = 100}}, 40},
    {"VerySlowFilterOfOrderThree", {{Plant::fotd, 3, Prefilter::none}, {.kappa = 1, .tau_i = 200, .tau_1 = 5, .tau_f = 30}}, 40},
    {"TinyIntegralTime", {{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.01, .tau_i = 0.02, .tau_1 = 0.5}}},
    {"VeryLongIntegralTime", {{Plant::ipdt, 0, Prefilter::pi}, {.kappa = 0.4, .tau_i = 1e6}}},
    {"NoIntegralAction", {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.08, .delta = 0.4, .tau_f = 0.1}}},
    {"NoDerivative", {{Plant::ipdt, 2, Prefilter::full}, {.kappa = 0.3, .tau_i = 8, .tau_f = 0.1}}},
    {"NearlyNoDerivative", {{Plant::ipdt, 2, Prefilter::none}, {.kappa = 0.3, .tau_i = 8, .delta = 1e-12, .tau_f = 0.1}}},
    {"JustInsideTheStabilityLimit", {{Plant::ipdt, 0, Prefilter::none}, {.kappa = kLimit * (1 - 1e-6)}}, 40},
    {"NeutralOnIpdt", {{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.05, .delta = 0.95}}},
    {"NeutralOnFotd", {{Plant::fotd, 0, Prefilter::pi}, {.kappa = 0.2, .tau_i = 3, .delta = 1.8, .tau_1 = 2}}},
    {"VerySlowLag", {{Plant::fotd, 1, Prefilter::full}, {.kappa = 40, .tau_i = 100, .delta = 4, .tau_1 = 100, .tau_f = 0.1}}},
    {"VerySlowMode", {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 1e-6, .tau_i = 1e5, .delta = 2e-3, .tau_f = 0.1}}, 40},
    {"TinyGain", {{Plant::ipdt, 0, Prefilter::none}, {.kappa = 1e-9}}},
    {"TinyLag", {{Plant::fotd, 1, Prefilter::pi}, {.kappa = 0.3, .tau_i = 0.6, .tau_1 = 0.01, .tau_f = 0.1}}},
    {"EightLags", {{Plant::jotd, 2, Prefilter::full, 8}, {.kappa = 0.5, .tau_i = 3, .delta = 0.6, .tau_f = 0.1, .tau_j = 0.5}}},
    {"OneDeadTime", {{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.1248, .tau_i = 10.3, .delta = 0.5, .tau_f = 0.1}}, 1},
};

class Corners : public ::testing::TestWithParam<Corner> {};
INSTANTIATE_TEST_SUITE_P(OfTheDomain, Corners, ::testing::ValuesIn(kCorners),
                         [](const auto& corner) { return corner.param.name; });

TEST_P(Corners, AllThreeAgree) {
  const Corner& corner = GetParam();
  SCOPED_TRACE(simulate_command(corner.loop));
  ASSERT_EQ(why_invalid(corner.loop), std::nullopt);
  ASSERT_TRUE(is_stable_by_contour(corner.loop));
  const LoopErrors e = audited(corner.loop, corner.dead_times);
  for (std::size_t method = 0; method < kMethods; ++method) {
    EXPECT_EQ(e.measured[method].status, e.truth.status) << kMethodNames[method];
    for (std::size_t k = 0; k < kKinds; ++k) {
      const Worst& worst = e.worst[method][k];
      EXPECT_LE(worst.error, kAllowed[k]) << kMethodNames[method] << ": " << to_string(worst.measure) << " = " << worst.found
                                          << ", is " << worst.truth;
    }
  }
}

TEST(StabilityLimit, AllThreeFindItToAMillionth) {
  for (const double off : {-1e-6, 1e-6}) {
    const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = kLimit * (1 + off)}};
    SCOPED_TRACE(simulate_command(loop));
    EXPECT_EQ(is_stable_by_contour(loop), off < 0);
    for (std::size_t method = 0; method < kMethods; ++method) {
      SettingMeasured measured;
      measure_settings(static_cast<Method>(method), loop.family, Horizon::fixed(5), {}, {&loop.setting, 1}, {&measured, 1});
      EXPECT_EQ(measured.status == Status::unstable, off > 0) << kMethodNames[method];
    }
  }
}

/// An audit that finds nothing wrong must have looked.
TEST(Comparison, SeesADigitThatIsWrong) {
  const Loop loop = kCorners.front().loop;
  const LoopErrors e = audited(loop, 12);
  for (std::size_t method = 0; method < kMethods; ++method) EXPECT_FALSE(exceeds(e.worst[method]));
  for (const Measure m : {Measure::IAE_w, Measure::TV2_ud, Measure::u_max_d, Measure::Ms, Measure::DM}) {
    MeasureRow wrong = e.measured[0].measures;
    wrong[m] *= 1 + 1e-5;
    if (m == Measure::TV2_ud) wrong[m] += 1e-5;
    EXPECT_TRUE(exceeds(compared(wrong, e.truth.measures))) << to_string(m);
    wrong[m] = kNaN;
    EXPECT_TRUE(exceeds(compared(wrong, e.truth.measures))) << to_string(m);
  }
}

}  // namespace
}  // namespace portrait::audit
