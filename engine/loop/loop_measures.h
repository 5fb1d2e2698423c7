/// The measures of a loop alone, which no response is needed for: Ms, Mt, their frequencies, GM, GM_low, PM, DM and
/// noise_gain.
#pragma once

#include <optional>

#include "engine/loop/loop.h"
#include "engine/loop/open_loop.h"
#include "engine/measures/catalogue.h"

namespace portrait {

/// `sampling` in dead times, for noise_gain, which is left as it is without it.
/// REQUIRES: the loop is stable; sampling is finite and above 0.
void measure_loop(const Loop& loop, std::optional<double> sampling, MeasureRow& row);

/// All but noise_gain. REQUIRES: the loop is stable.
void measure_loop(const OpenLoop& open, MeasureRow& row);

}  // namespace portrait
