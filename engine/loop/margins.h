/// How far a stable loop is from losing its stability: gain, phase and delay margins.
///
///     gain       smallest factor above 1 on L at which the loop is no longer stable: the least 1/|L| above 1 over
///                the phase crossovers, and 1/|L(inf)| of a neutral loop
///     gain_low   largest such factor below 1; 0 when there is none
///     phase_deg  smallest turn of L, lag or lead, that puts a gain crossover on -1, in degrees, 0 .. 180; inf
///                without gain crossover
///     delay      smallest further dead time at which the loop is no longer stable; inf without gain crossover
///
/// method    cut at its gain crossovers and at the extremes of |L| and of arg L, all roots of polynomials, the
///           frequency axis falls into intervals on which |L| and arg L are monotonic: of each only the phase
///           crossover next to |L| = 1 can matter. Nothing is sampled, and none is missed among infinitely many.
/// unit      gains 1, delay in dead times
/// accuracy  1e-10 relative: tests/engine/loop/margins_test.cpp
/// cost      some ten evaluations of L an interval, of which there are about ten
#pragma once

#include "engine/loop/open_loop.h"

namespace portrait {

struct Margins {
  double gain;
  double gain_low;
  double phase_deg;
  double delay;
};

/// REQUIRES: the loop is stable.
Margins margins(const OpenLoop& loop);

/// `phase_deg` and `delay` alone, which the gain crossovers settle.
struct PhaseMargins {
  double phase_deg, delay;
};
PhaseMargins phase_margins(const OpenLoop& loop, const std::vector<double>& crossovers);

}  // namespace portrait
