/// Many loops under measurement noise: their responses at the instants k Ts, noise added, and measured, in lanes.
///
/// The definitions are those of engine/reference/noise.h. A setting is simulated twice where its prefilter is not 1: what noise
/// does is minus what a setpoint does that passes no prefilter.
/// domain    fixed horizons; a proper controller: a filter, or no derivative action
/// accuracy  1e-8 of a signal's variation under noise: tests/engine/kernel/noise_test.cpp
/// result    a setting's bits do not depend on its neighbours; instruction sets agree to 1e-12
/// cost      n log n for n samples, and again for each seed
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/kernel/responses.h"
#include "engine/loop/noise.h"

namespace portrait::kernel {

inline constexpr std::size_t kMostNoiseSamples = 131'072;   ///< up to the horizon
inline constexpr std::size_t kMostNoiseValues = 4'000'000;  ///< samples times seeds

/// The values of all seeds up to a horizon, and their spectra: the same for every setting.
class DrawnNoise {
 public:
  /// REQUIRES: horizon and sampling finite, above 0; at least one seed; at most so many samples and values as above.
  DrawnNoise(const NoiseTrials& trials, double horizon);

  const NoiseTrials& trials() const { return trials_; }
  double horizon() const { return horizon_; }
  int samples() const { return samples_; }
  int size() const { return size_; }
  const std::vector<double>& turns() const { return turns_; }
  const std::vector<double>& spectra() const { return spectra_; }
  /// Sum of the squares of the values of the second half, seed by seed.
  const std::vector<double>& squares() const { return squares_; }

 private:
  void draw(int seed);

  NoiseTrials trials_;
  double horizon_;
  int samples_, size_;
  std::vector<double> turns_, spectra_, squares_;
};

/// measure_responses, and the noisy measures beside: a response that is not resolved has none.
/// REQUIRES: settings valid and stable; as many results; a proper controller.
void measure_under_noise(const Implementation& implementation, const LoopFamily& family,
                         std::span<const Setting> settings, const DrawnNoise& noise, std::span<Measured> results);

}  // namespace portrait::kernel
