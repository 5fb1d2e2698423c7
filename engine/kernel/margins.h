/// Stability, Ms, Mt and the margins of many loops: the fast path's front door.
///
/// Loops with one gain crossover, by the signs of a polynomial's coefficients, go side by side into packs; the few others
/// are left to engine/loop, which takes any loop.
/// shape     any number of settings of one family
/// accuracy  1e-8 relative against engine/loop/sensitivity.h and margins.h, the count of unstable roots exact:
///           tests/engine/kernel/margins_test.cpp
/// result    a setting's bits do not depend on its neighbours
#pragma once

#include <span>

#include "engine/kernel/pack.h"
#include "engine/loop/loop.h"

namespace portrait::kernel {

/// NaN where the loop is unstable; units as in engine/measures/catalogue.h.
struct LoopMargins {
  bool stable = false;
  double Ms = kNaN, Ms_omega = kNaN, Mt = kNaN, Mt_omega = kNaN;
  double GM = kNaN, GM_low = kNaN, PM = kNaN, DM = kNaN;
};

/// REQUIRES: settings valid; as many results.
void find_margins(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                  std::span<LoopMargins> results);

}  // namespace portrait::kernel
