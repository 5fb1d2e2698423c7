/// Both step responses of many settings, measured: the fast path's front door.
///
/// Settings of a kind go side by side into packs. A dead time is cut into panels after the setting's own time constants; a
/// setting whose series have not died out is run again on finer panels, so the result is resolved whatever the constants are.
/// shape     any number of settings of one family
/// domain    n = 0 .. kMaxFilterOrder, every plant; prefilter `full` with n = 0 is refused, see `kernel_takes`
/// accuracy  against the reference, tau_f and tau_1 from 0.01: IAE 1e-8; TV, and TV0 to TV2 as parts of TV, 1e-7. Where TV
///           is large and TV2 small, as behind a step through a strong derivative, TV2 has fewer digits of its own:
///           tests/engine/kernel/many_responses_test.cpp
/// result    a setting's bits do not depend on its neighbours in the pack; instruction sets agree to 1e-12 of a signal's
///           variation without strong layers, to 1e-9 everywhere
#pragma once

#include <span>

#include "engine/base/status.h"
#include "engine/kernel/pack.h"
#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"

namespace portrait::kernel {

/// Integrals of the error that the catalogue does not name yet.
struct ErrorIntegrals {
  double ISE, ITAE, ITSE;
};

struct LaneMeasured {
  Status status = Status::not_computed;
  MeasureRow measures;  ///< those of the responses; Ms and Mt are left to engine/loop/sensitivity.h
  ErrorIntegrals w, d;
  bool resolved = false;  ///< false: not even the finest panels resolve this setting
};

/// Whether the kernel has this family: all but n = 0 behind `full`, whose second-order prefilter does not cancel.
bool kernel_takes(const LoopFamily& family);

/// REQUIRES: kernel_takes(family); settings valid and stable; as many results.
void measure_responses(const Implementation& implementation, const LoopFamily& family,
                       std::span<const Setting> settings, Horizon horizon, std::span<LaneMeasured> results);

}  // namespace portrait::kernel
