/// Floating-point operations of the kernel, counted while it runs, repetitions on finer panels included. Stability
/// and Ms are not counted: they run outside the kernel.
#pragma once

#include "bench/cases.h"

namespace portrait::bench {

/// Per setting, over some packs of neighbours from all over the case. What counts as one: bench/counted_lanes.inl.
double flops_a_setting(const Case& of);

}  // namespace portrait::bench
