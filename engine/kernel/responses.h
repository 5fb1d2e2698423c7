/// Both step responses of many settings, measured: the fast path's front door.
///
/// Settings of a kind go side by side into packs. A dead time is cut into panels after the setting's own time constants; a
/// setting whose series have not died out is run again on finer panels, so the result is resolved whatever the constants are.
/// shape     any number of settings of one family
/// domain    every plant, prefilter and n = 0 .. kMaxFilterOrder
/// accuracy  against the reference, tau_f and tau_1 from 0.01: IAE 1e-8; TV, and TV0 to TV2 as parts of TV, 1e-7. Where TV
///           is large and TV2 small, as behind a step through a strong derivative, TV2 has fewer digits of its own:
///           tests/engine/kernel/many_responses_test.cpp
/// result    a setting's bits do not depend on its neighbours in the pack; instruction sets agree to 1e-12 of a signal's
///           variation: tests/engine/kernel/responses_test.cpp
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/base/status.h"
#include "engine/kernel/pack.h"
#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"

namespace portrait::kernel {

struct Measured {
  Status status = Status::not_computed;
  MeasureRow measures;    ///< those of the responses, the others NaN
  double horizon = 0;     ///< dead times simulated; 0 when unstable
  bool resolved = false;  ///< false: not even the finest panels resolve this setting, and nothing here counts
};

/// The signals of many settings at the instants k Ts: limits from the right.
class SampledResponses {
 public:
  enum Signal { kYw, kUw, kYd, kUd, kSignals };

  SampledResponses(double sampling, std::size_t count, std::size_t settings)
      : sampling_(sampling), count_(count), values_(settings * kSignals * count) {}

  double sampling() const { return sampling_; }
  std::size_t count() const { return count_; }
  std::span<double> of(std::size_t setting, Signal signal) {
    return std::span(values_).subspan((setting * kSignals + signal) * count_, count_);
  }
  std::span<const double> of(std::size_t setting, Signal signal) const {
    return std::span(values_).subspan((setting * kSignals + signal) * count_, count_);
  }

 private:
  double sampling_;
  std::size_t count_;
  std::vector<double> values_;
};

/// `samples`, where it is given, takes those of every setting that is resolved; the measures have the same bits with it as
/// without. REQUIRES: settings valid and stable; as many results; with samples, a fixed horizon.
void measure_responses(const Implementation& implementation, const LoopFamily& family,
                       std::span<const Setting> settings, Horizon horizon, std::span<Measured> results,
                       SampledResponses* samples = nullptr);

}  // namespace portrait::kernel
