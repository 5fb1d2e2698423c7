/// Where L(j omega) is real and negative: arg L is an odd multiple of pi.
///
/// Between two neighbouring `phase_extremes` arg L is monotonic and known in closed form, so a bracket and Newton's
/// method find a crossover to rounding, and none can be missed. The dead time makes them infinitely many.
/// unit      omega in radians per dead time
#pragma once

#include <optional>
#include <vector>

#include "engine/loop/open_loop.h"

namespace portrait {

/// The crossover next to `from` on the way to `to`, both included but for 0; nothing when there is none. `to` may
/// be inf, and either may be the larger one.
/// REQUIRES: no phase extreme lies strictly between; 0 <= from, to; from is finite.
std::optional<double> nearest_phase_crossover(const OpenLoop& loop, double from, double to);

/// All of them in (0, highest], increasing. REQUIRES: highest is finite.
std::vector<double> phase_crossovers(const OpenLoop& loop, double highest);

}  // namespace portrait
