/// Everything about many loops, the fast way: what engine/reference/measure.h gives for one.
///
/// Stability and margins first, then the responses of the settings that are stable.
/// shape     any number of settings of one family
/// accuracy  see responses.h and margins.h
/// result    a setting's bits do not depend on its neighbours
#pragma once

#include <span>

#include "engine/kernel/noise.h"

namespace portrait::kernel {

/// Without `with_margins` those that would be searched one by one are left NaN; with `noise`, drawn for this horizon, there are
/// the noisy measures too. REQUIRES: settings valid; as many results.
void measure(const Implementation& implementation, const LoopFamily& family, Horizon horizon,
             std::span<const Setting> settings, std::span<Measured> results, bool with_margins = true,
             const DrawnNoise* noise = nullptr);

}  // namespace portrait::kernel
