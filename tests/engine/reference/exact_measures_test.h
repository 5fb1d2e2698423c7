/// The measures of the reference simulation against those of exact responses, for any loop.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/measures/step_measures.h"
#include "engine/reference/measure.h"
#include "tests/oracle/method_of_steps.h"

namespace portrait::reference {

/// Relative; those of TV0, TV1, TV2 are relative to TV.
struct Promise {
  double iae, tv;  ///< iae for all four integrals of the error
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

inline void expect_error_integrals(const MeasureRow& row, const StepMeasures& names, const oracle::Signal& y,
                                   double target, bool vanishes, double promise) {
  const oracle::ErrorIntegrals exact = oracle::error_integrals(y, target);
  const std::pair<Measure, oracle::Real> expected[] = {
      {names.IAE, exact.IAE}, {names.ISE, exact.ISE}, {names.ITAE, exact.ITAE}, {names.ITSE, exact.ITSE}};
  for (const auto& [measure, integral] : expected) {
    const auto value = static_cast<double>(integral);
    EXPECT_EQ(std::isnan(row[measure]), !vanishes) << to_string(measure);
    if (vanishes) {
      EXPECT_NEAR(row[measure], value, promise * value) << to_string(measure);
    }
  }
}

/// All measures of the two steps over so many dead times. `pieces` as in MethodOfSteps.
inline void expect_exact_measures(const Loop& loop, int pieces, int dead_times, const Promise& promise) {
  SCOPED_TRACE(simulate_command(loop));
  const MeasureRow row = measure(loop, Horizon::fixed(dead_times)).measures;
  for (const Step step : {kSetpoint, kDisturbance}) {
    oracle::MethodOfSteps exact(loop, step == kSetpoint ? 1 : 0, step == kDisturbance ? 1 : 0, pieces);
    exact.run_to(dead_times);
    const SteadyState rest = steady_state(loop, step);
    const double target = step == kSetpoint ? 1 : 0;
    const StepMeasures& names = step == kSetpoint ? kSetpointMeasures : kDisturbanceMeasures;
    expect_error_integrals(row, names, exact.y(), target, rest.y == target, promise.iae);
    const SignalMeasures y{names.of_y, names.y_max}, u{names.of_u, names.u_max};
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
