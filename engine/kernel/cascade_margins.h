/// Stability and margins of loops of many lags or of gains.
///
/// Stability, PM and DM come from the gain crossovers, which are the roots of a polynomial, as in engine/loop. The peaks and gain
/// margins of loops with one crossover or none are then searched side by side; the few others are left to engine/loop.
/// accuracy  as engine/kernel/margins.h: tests/engine/kernel/cascade_margins_test.cpp
#pragma once

#include <span>

#include "engine/kernel/margins.h"

namespace portrait::kernel {

/// What find_margins does for such families. REQUIRES: plant_kind(family) is a cascade; as there.
void find_cascade_margins(const Implementation& implementation, const LoopFamily& family,
                          std::span<const Setting> settings, std::span<LoopMargins> results, bool wanted);

/// The lanes' result, PM, DM and stability apart.
void take_lane(const MarginResult& found, std::size_t lane, MarginRow& row);

/// All of them by engine/loop. REQUIRES: the loop is stable.
void take_exact(const Loop& loop, MarginRow& row);

}  // namespace portrait::kernel
