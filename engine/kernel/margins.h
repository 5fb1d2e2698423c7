/// Stability, Ms, Mt and the margins of many loops: the fast path's front door.
///
/// Loops that cross |L| = 1 once, or never, go side by side into packs; the few others are left to engine/loop, which takes
/// any loop.
/// shape     any number of settings of one family
/// accuracy  1e-8 relative against engine/loop/sensitivity.h and margins.h, the count of unstable roots exact:
///           tests/engine/kernel/margins_test.cpp
/// result    a setting's bits do not depend on its neighbours; instruction sets agree to 1e-12
#pragma once

#include <array>
#include <span>

#include "engine/kernel/pack.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"

namespace portrait::kernel {

inline constexpr std::array kMarginMeasures = {Measure::Ms, Measure::Mt,     Measure::Ms_omega, Measure::Mt_omega,
                                               Measure::GM, Measure::GM_low, Measure::PM,       Measure::DM};

struct LoopMargins {
  bool stable = false;
  MeasureRow measures;  ///< kMarginMeasures of a stable loop, all else NaN
};

/// Families of many lags or of gains are searched one by one, and only for stability where margins are not `wanted`.
/// REQUIRES: settings valid; as many results.
void find_margins(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                  std::span<LoopMargins> results, bool wanted = true);

}  // namespace portrait::kernel
