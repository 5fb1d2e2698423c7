/// Peaks of the sensitivity functions found by looking everywhere: a dense scan of the frequency axis, and golden
/// section about every sample that stands out. Evaluates C Q P as it is written, and judges the search of
/// engine/loop/sensitivity.h.
#pragma once

#include <complex>

#include "engine/loop/loop.h"

namespace portrait {

/// C(s) Q(s) P(s) at s = j omega, as written.
std::complex<double> open_loop_as_written(const Loop& loop, double omega);

struct Peaks {
  double Ms, Mt;
};

/// The limit omega -> inf of a neutral loop counts. REQUIRES: the loop is stable.
Peaks peaks_by_scan(const Loop& loop);

}  // namespace portrait
