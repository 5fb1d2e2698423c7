/// The measures of the reference simulation against those of exact responses, for any loop.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "tests/oracle/method_of_steps.h"

namespace portrait::reference {

/// Relative; those of TV0, TV1, TV2 are relative to TV.
struct Promise {
  double iae, tv;
};

/// What the header of engine/reference/response.h promises.
inline constexpr Promise kPromise = {1e-9, 1e-7};

/// TV, TV0, TV1, TV2 and the largest magnitude.
struct SignalMeasures {
  std::array<Measure, 4> tv;
  Measure largest;
};

inline void expect_signal_measures(const MeasureRow& row, const SignalMeasures& measures,
                                   const oracle::Signal& exact, double at_rest, const Promise& promise) {
  const auto points = oracle::turning_points(exact);
  const auto variation = static_cast<double>(oracle::variation(points));
  EXPECT_NEAR(row[measures.tv[0]], variation, promise.tv * variation) << to_string(measures.tv[0]);
  for (int m = 0; m <= 2; ++m) {
    const Measure measure = measures.tv[static_cast<std::size_t>(m) + 1];
    const auto expected = static_cast<double>(oracle::shape_deviation(points, at_rest, m));
    EXPECT_NEAR(row[measure], expected, promise.tv * variation) << to_string(measure);
  }
  double largest = 0;
  for (const oracle::Real x : points) largest = std::max(largest, static_cast<double>(std::abs(x)));
  EXPECT_NEAR(row[measures.largest], largest, promise.tv * largest) << to_string(measures.largest);
}

/// All measures of the two steps over so many dead times. `pieces` as in MethodOfSteps.
inline void expect_exact_measures(const Loop& loop, int pieces, int dead_times, const Promise& promise) {
  using enum Measure;
  SCOPED_TRACE(simulate_command(loop));
  const MeasureRow row = measure(loop, Horizon::fixed(dead_times)).measures;
  for (const Step step : {kSetpoint, kDisturbance}) {
    oracle::MethodOfSteps exact(loop, step == kSetpoint ? 1 : 0, step == kDisturbance ? 1 : 0, pieces);
    exact.run_to(dead_times);
    const SteadyState rest = steady_state(loop, step);
    const double target = step == kSetpoint ? 1 : 0;
    const double iae = row[step == kSetpoint ? IAE_w : IAE_d];
    const auto expected = static_cast<double>(oracle::integral_of_error(exact.y(), target));
    EXPECT_EQ(std::isnan(iae), rest.y != target);
    if (rest.y == target) {
      EXPECT_NEAR(iae, expected, promise.iae * expected) << "IAE of step " << step;
    }
    const bool w = step == kSetpoint;
    const SignalMeasures y = w ? SignalMeasures{{TV_yw, TV0_yw, TV1_yw, TV2_yw}, y_max_w}
                               : SignalMeasures{{TV_yd, TV0_yd, TV1_yd, TV2_yd}, y_max_d};
    const SignalMeasures u = w ? SignalMeasures{{TV_uw, TV0_uw, TV1_uw, TV2_uw}, u_max_w}
                               : SignalMeasures{{TV_ud, TV0_ud, TV1_ud, TV2_ud}, u_max_d};
    expect_signal_measures(row, y, exact.y(), rest.y, promise);
    expect_signal_measures(row, u, exact.u(), rest.u, promise);
  }
}

/// Pieces of at most four of the loop's shortest time constant, for the power series.
inline int pieces_for(const Loop& loop) {
  const Setting& s = loop.setting;
  double shortest = s.tau_i;
  if (s.delta > 0) shortest = std::min(shortest, tau_d(s));
  if (loop.family.n > 0) shortest = std::min(shortest, s.tau_f);
  if (loop.family.plant == Plant::fotd) shortest = std::min(shortest, s.tau_1);
  return 1 + static_cast<int>(1 / (4 * shortest));
}

}  // namespace portrait::reference
