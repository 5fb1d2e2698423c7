/// The margins in lanes, of one loop, against the exact search of engine/loop.
#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "engine/isa/dispatch.h"
#include "engine/kernel/margins.h"
#include "engine/loop/loop_measures.h"
#include "engine/loop/open_loop.h"
#include "engine/loop/parameters.h"
#include "engine/loop/stability.h"
#include "tests/oracle/random_loops.h"

namespace portrait {

class LaneMargins : public ::testing::TestWithParam<const kernel::Implementation*> {
 protected:
  kernel::LoopMargins margins_of(const Loop& loop) const {
    kernel::LoopMargins found;
    kernel::find_margins(*GetParam(), loop.family, {&loop.setting, 1}, {&found, 1});
    return found;
  }

  /// Values within 1e-9; places within 1e-8, where the peak is no flat one at rest and no other is as high.
  void expect_exact(const Loop& loop) const {
    const kernel::LoopMargins found = margins_of(loop);
    ASSERT_EQ(found.stable, is_stable(open_loop(loop))) << simulate_command(loop);
    if (!found.stable) return;
    MeasureRow exact;
    measure_loop(loop, std::nullopt, exact);
    for (const Measure m : kernel::kMarginMeasures) {
      const bool is_place = m == Measure::Ms_omega || m == Measure::Mt_omega;
      const bool right =
          is_place ? same_place(loop, m, found.measures[m], exact[m]) : within(found.measures[m], exact[m], 1e-9);
      EXPECT_TRUE(right) << to_string(m) << " is " << found.measures[m] << ", the exact search says " << exact[m]
                         << ": " << simulate_command(loop);
    }
  }

 private:
  static bool within(double a, double b, double tolerance) {
    return a == b || std::abs(a - b) <= tolerance * std::abs(b);
  }

  static double height(const Loop& loop, Measure place, double omega) {
    const std::complex<double> L = response_at(open_loop(loop), omega);
    return (place == Measure::Ms_omega ? 1.0 : std::abs(L)) / std::abs(1.0 + L);
  }

  static bool same_place(const Loop& loop, Measure place, double found, double exact) {
    if (within(found, exact, 1e-8)) return true;
    if (std::max(found, exact) < 1e-5) return true;
    const bool apart = !within(found, exact, 0.01);
    return apart && (std::isinf(exact) || std::isinf(found) ||
                     within(height(loop, place, found), height(loop, place, exact), 1e-10));
  }
};

inline std::string isa_name(const ::testing::TestParamInfo<const kernel::Implementation*>& isa) {
  return isa.param->name;
}

/// Stable or not.
inline Loop random_loop(oracle::Random& random) {
  const auto plant = static_cast<Plant>(random.below(3));
  const int n = random.below(5);
  Loop loop{{plant, n, Prefilter::none}, oracle::random_controller(random, plant, random.log_uniform(0.01, 100))};
  if (n > 0) loop.setting.tau_f = random.log_uniform(1e-4, 1);
  return loop;
}

}  // namespace portrait
