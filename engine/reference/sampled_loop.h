/// A loop whose controller runs at a sampling time: it reads the noisy output, and holds u until the next instant.
///
/// Controller and prefilter are replaced by what they are for inputs held over Ts (for a PI controller that is the sum of
/// errors so far, u_k = Kp e_k + Ki Ts (e_0 + ... + e_(k-1))); the plant is taken from instant to instant exactly. Its
/// delayed output is exact for every Ts: where Ts does not divide the dead time, the plant's state a dead time ago is
/// reached from the instant before it.
///
/// unit      normalised
/// domain    controllers that are proper: the ideal derivative has no value at an instant
/// accuracy  that of matrix exponentials; tests/engine/reference/noise_test.cpp
/// cost      two small products a sample
#pragma once

#include <optional>

#include "engine/reference/noise.h"

namespace portrait::reference {

/// One response, at the instants k Ts; y is the plant's true output. `noise` without value: none.
/// REQUIRES: the loop is valid and normalised, its controller proper; horizon/sampling < kMostSamples.
Sampled simulate_sampled(const GeneralLoop& loop, Step step, double sampling, double horizon,
                         const std::optional<Noise>& noise);

}  // namespace portrait::reference
