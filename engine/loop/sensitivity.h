/// Peaks of the closed loop's sensitivity functions over all frequencies.
///
///     Ms = sup_w |1/(1 + L(jw))|        Mt = sup_w |L(jw)/(1 + L(jw))|                    [Dalen2018 (10)]
///
/// method    branch and bound: over an interval of frequencies |1 + L| is bounded from below by the extremes of
///           |L| and by a Lipschitz constant, so an interval that cannot hold the peak is dropped without
///           sampling it; in what is left the peaks are found as sign changes of the derivative. The limits
///           w -> 0 and w -> inf count: a neutral loop has 1/(1 - |L(inf)|) among its values.
/// unit      1; omega in radians per dead time; inf for a supremum in the limit w -> inf, 0 for w -> 0
/// accuracy  1e-10 relative: tests/engine/loop/sensitivity_test.cpp
/// cost      some ten microseconds
#pragma once

#include "engine/loop/open_loop.h"

namespace portrait {

struct Peak {
  double value;
  double omega;
};

/// Ms. REQUIRES: the loop is stable.
Peak sensitivity_peak(const OpenLoop& loop);

/// Mt. REQUIRES: the loop is stable.
Peak complementary_sensitivity_peak(const OpenLoop& loop);

}  // namespace portrait
