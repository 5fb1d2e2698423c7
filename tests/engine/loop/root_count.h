/// Roots of the characteristic quasi-polynomial in the right half-plane, counted the long way.
///
///     f(s) = D(s) + N(s) e^{-s}
///
/// The argument principle on a contour that is walked step by step: up the imaginary axis to jR, where |N/D| has
/// fallen below 1 for good, and back to the real axis on a quarter circle; f is real on the real axis, and the
/// lower half is the mirror image. In long double, with steps so short that f turns by a quarter of a radian at
/// most. Slow, knows nothing of crossovers, and judges `unstable_roots`.
#pragma once

#include "engine/loop/general_loop.h"
#include "engine/loop/loop.h"

namespace portrait {

/// REQUIRES: the loop is valid; a neutral loop's high-frequency gain is below 1.
int unstable_roots_by_contour(const Loop& loop);

/// Of a general loop. REQUIRES: as above; none of its roots lies on the imaginary axis.
int unstable_roots_by_contour(const GeneralLoop& loop);

}  // namespace portrait
