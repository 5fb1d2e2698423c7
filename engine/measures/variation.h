/// Total variation of a signal, and its distance from the nearest response with at most m pulses.
///
/// A signal is given by its turning points in order of time: x(0-), every local extreme and both ends of
/// every jump, and x at the horizon. Between neighbours it is monotonic.
///
///     TV    sum of |increments|                                                          [Huba2022, section 2]
///     TVm   TV less the variation of the best m-pulse shape: x(0-), at most m of the turning points, in order
///           of time and alternately above and below x(inf), then x(inf)                 [Huba2022 (2), (3), (5)]
///
/// A point at x(inf) itself lies on neither side and is no extreme.
/// TVm counts the leg from the horizon to x(inf) as part of the signal: without it a monotonic response that
/// is cut off early would have a TV0 below 0.
/// accuracy  sums of differences of the points given; TVm >= 0 up to rounding:
///           tests/engine/measures/variation_test.cpp
/// cost      one pass, m + 1 numbers of state
#pragma once

#include <span>

namespace portrait {

double total_variation(std::span<const double> turning_points);

/// TVm. REQUIRES: at least one turning point, m >= 0.
double shape_deviation(std::span<const double> turning_points, double x_infinity, int m);

/// Dynamic class: how many extremes lie alternately above and below x(inf), by more than `tolerance`.  [Huba2021 (41)]
/// Where x comes from x(0-) on the side on which it ends, only points beyond x(0-) count as an extreme there.
int alternating_extremes(std::span<const double> turning_points, double x_infinity, double tolerance);

}  // namespace portrait
