/// Stability by counting roots of the characteristic quasi-polynomial f(s) = D(s) + N(s) e^{-Td s}.
///
/// The argument principle needs the change of arg f along the imaginary axis. Where |L| < 1 the point 1 + L
/// stays in the right half-plane, and where |L| > 1 so does 1 + 1/L: on either side arg f is known in closed
/// form, from arg D or from arg N, but for a multiple of 2 pi. That multiple can change only where |L| = 1,
/// and the crossovers are the roots of a polynomial. So the count is exact, without sampling the frequency
/// axis:
///
///     Z = P - 2 sum_i  sigma_i round(phi_i / (2 pi))  [- 1 for a negative gain, where |L| > 1 at omega = 0]
///
/// over the crossovers omega_i, with phi_i the continuous phase of L there and sigma_i = +1 where |L| falls
/// below 1, -1 where it rises above; P are the poles of L in the open right half-plane.
/// accuracy  right for loops 1e-9 from the boundary on either side, by kappa, where that much gain turns the
///           phase at the crossover by more than rounding does: tests/engine/loop/stability_test.cpp
/// cost      the positive roots of one small polynomial
#pragma once

#include "engine/loop/open_loop.h"

namespace portrait {

/// More are not counted: a crossover far above 1/Td can stand for more turns than any integer holds.
inline constexpr int kMostRoots = 1'000'000'000;

/// Roots in the open right half-plane, at most kMostRoots. REQUIRES: high_frequency_gain(loop) < 1 (else infinitely many).
int unstable_roots(const OpenLoop& loop);

/// Every root in the open left half-plane; a neutral loop uniformly so.
bool is_stable(const OpenLoop& loop);

/// The same where gain_crossovers(loop) are known.
int unstable_roots(const OpenLoop& loop, const std::vector<double>& crossovers);
bool is_stable(const OpenLoop& loop, const std::vector<double>& crossovers);

}  // namespace portrait
