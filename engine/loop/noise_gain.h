/// RMS of u per RMS of white measurement noise that is held over the sampling time Ts (independent values, each
/// held until the next), averaged over time:
///
///     noise_gain^2 = (1/pi) int_0^inf |C Q/(1 + L)|^2 Ts (sin(w Ts/2)/(w Ts/2))^2 dw
///
/// method    adaptive quadrature along the real axis up to some W beyond the last gain crossover. From there on
///           |S|^2 = (2 Re S - 1)/(1 - |L|^2), where 1 - |L|^2 is rational and S analytic in the right half-plane:
///           the path is turned into the complex plane, where e^{-s} and e^{-s Ts} die out instead of turning. What
///           grows there, e^{s Ts} against the first powers of e^{-s}, is turned the other way.
/// unit      Ts in dead times; of u per y, normalised
/// domain    n = 0 with derivative action: inf, for steps of the noise become impulses
/// accuracy  1e-8 relative: tests/engine/loop/noise_gain_test.cpp
/// cost      about a thousand evaluations of L, more for Ts beyond some dead times
#pragma once

#include "engine/loop/loop.h"

namespace portrait {

/// REQUIRES: the loop is stable; sampling is finite and above 0.
double noise_gain(const Loop& loop, double sampling);

}  // namespace portrait
