/// Peaks of the closed loop's sensitivity functions over all frequencies.
///
///     Ms = sup_w |1/(1 + L(jw))|        Mt = sup_w |L(jw)/(1 + L(jw))|                    [Dalen2018 (10)]
///
/// method    branch and bound: over an interval of frequencies the function lies below its second-order
///           expansion about the middle, with the rest bounded by the factors of L (of 1/L where |L| > 1); the
///           interval that promises most is cut first, until none promises more than has been found. Nothing is
///           sampled and no peak can be missed. The limits w -> 0 and w -> inf count: a neutral loop has
///           1/(1 - |L(inf)|) among its values.
/// unit      1; omega in radians per dead time; inf for a supremum in the limit w -> inf, 0 for w -> 0
///           Of several peaks within 2e-11 of the highest any may be the one whose omega is told.
/// accuracy  1e-10 relative, omega 1e-8 relative: tests/engine/loop/sensitivity_test.cpp
/// cost      some hundred evaluations of L
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
