/// The margins in lanes, of one loop, against the exact search of engine/loop.
#pragma once

#include <cmath>
#include <string>
#include <vector>

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

inline void expect_same_alone(const kernel::Implementation& implementation, const LoopFamily& family,
                              const std::vector<Setting>& settings) {
  std::vector<kernel::LoopMargins> together(settings.size());
  kernel::find_margins(implementation, family, settings, together);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    kernel::LoopMargins alone;
    kernel::find_margins(implementation, family, {&settings[i], 1}, {&alone, 1});
    ASSERT_EQ(alone.stable, together[i].stable);
    if (!alone.stable) continue;
    for (const Measure m : kernel::kMarginMeasures)
      EXPECT_EQ(alone.measures[m], together[i].measures[m])
          << to_string(m) << ": " << simulate_command({family, settings[i]});
  }
}

/// To 1e-12: distances from -1 and angles of 1 and pi, places where the peak is not level relative to themselves.
inline void expect_same_on(const std::vector<const kernel::Implementation*>& sets, const Loop& loop) {
  std::vector<kernel::LoopMargins> of(sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k)
    kernel::find_margins(*sets[k], loop.family, {&loop.setting, 1}, {&of[k], 1});
  for (std::size_t k = 1; k < sets.size(); ++k) {
    const kernel::MarginRow &a = of[0].measures, &b = of[k].measures;
    ASSERT_EQ(of[k].stable, of[0].stable) << simulate_command(loop);
    for (const Measure m : {Measure::Ms, Measure::Mt, Measure::GM})
      EXPECT_NEAR(1 / a[m], 1 / b[m], 1e-12) << to_string(m) << ": " << simulate_command(loop);
    EXPECT_NEAR(a[Measure::GM_low], b[Measure::GM_low], 1e-12) << simulate_command(loop);
    for (const Measure m : {Measure::PM, Measure::DM})
      EXPECT_TRUE(a[m] == b[m] || std::abs(a[m] - b[m]) < 1e-12 * std::max(180.0, a[m])) << simulate_command(loop);
    for (const Measure m : {Measure::Ms_omega, Measure::Mt_omega})
      EXPECT_TRUE(a[m] == b[m] || std::abs(a[m] - b[m]) < 1e-10 * a[m])
          << to_string(m) << ' ' << a[m] << ' ' << b[m] << ": " << simulate_command(loop);
  }
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
