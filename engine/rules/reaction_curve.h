/// The process reaction curve of a plant that is known: the steepest tangent of its step response.
///
///     R_1 = the slope largest towards the final value, at t*;   L = t* - y(t*)/R_1, where the tangent meets the initial level
///                                                                              [Dalen2018 1.7, ZieglerNichols1942]
///
/// unit      R_1 in output per input and time, L in time
/// domain    strictly proper N/D with all poles left of 0, or one of them at 0 (R_1 may then lie at infinity)
/// accuracy  1e-10: tests/engine/rules/reaction_curve_test.cpp
#pragma once

#include <optional>

#include "engine/loop/polynomial.h"

namespace portrait::rules {

struct ReactionCurve {
  double slope, lag;
  double steepest_at;  ///< t*
};

/// Nothing when the slope grows to the end of every window: an unstable or a doubly integrating plant.
/// REQUIRES: N/D strictly proper.
std::optional<ReactionCurve> reaction_curve(const Polynomial& numerator, const Polynomial& denominator,
                                            double dead_time);

}  // namespace portrait::rules
