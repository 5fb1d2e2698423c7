/// Measurement noise: independent values, each held over the sampling time, added to the measured output.
///
/// The loop is linear, so what noise does is a sum of what one held value does: with h the response of u (or y) to a unit
/// step of the measured output, sampled just after the instants k Ts,
///
///     u_k = u(k Ts) + sum_j g_j n_(k-j),      g_0 = h(0),  g_j = h(j Ts) - h((j-1) Ts)
///
/// by a fast Fourier transform: exact for a continuous controller, any dead time, and any sampling time, which need
/// not divide it. u_k is the limit from the right, after the jump of the noise.
///
/// accuracy  1e-9 of the noise: tests/engine/reference/noise_test.cpp
/// cost      n log n for n samples, once more for each seed
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/loop/noise.h"
#include "engine/measures/catalogue.h"
#include "engine/reference/response.h"

namespace portrait::reference {

using portrait::Noise;
using portrait::noise_value;

inline constexpr std::size_t kMostSamples = 4'000'000;

/// A loop's answer to noise, for one sampling time and horizon.
class NoiseAnswer {
 public:
  /// `response` holds the output step, and was run until quiet: what comes after is at rest.
  /// REQUIRES: horizon/sampling < kMostSamples; sampling > 0.
  NoiseAnswer(const Response& response, double sampling, double horizon);

  std::size_t samples() const { return samples_; }

  /// What noise adds to u, or to the plant's true output, at k Ts, k = 0, 1, ...
  std::vector<double> u(const Noise& noise) const { return answer(u_taps_, noise); }
  std::vector<double> y(const Noise& noise) const { return answer(y_taps_, noise); }

  /// sigma of u at the instants over sigma of the noise, once it is stationary: sqrt(sum g_j^2).
  double u_sigma_ratio() const { return sigma_ratio(u_taps_); }
  /// The same of the increments u_k - u_(k-1): their mean magnitude, times samples, is TV of a loop at rest; for
  /// Gaussian noise it is sqrt(2/pi) sigma.
  double u_increment_ratio() const;

 private:
  static double sigma_ratio(const std::vector<double>& taps);
  std::vector<double> answer(const std::vector<double>& taps, const Noise& noise) const;

  std::size_t samples_;
  std::vector<double> u_taps_, y_taps_;
};

/// The measure noise_gain of engine/loop/noise_gain.h, for any loop: from the response to one held value,
///
///     noise_gain^2 = (1/Ts) int (h(t) - h(t - Ts))^2 dt
///
/// averaged over time, where `u_sigma_ratio` is at the instants alone. accuracy 1e-8 relative.
/// REQUIRES: `response` holds the output step, and was run until quiet.
double noise_gain(const Response& response, double sampling);

/// u and y of a step at the instants k Ts: limits from the right.
struct Sampled {
  std::vector<double> y, u;
};
Sampled sampled(const StepResponse& response, double sampling, std::size_t samples);

/// The noisy measures of the catalogue, over all seeds. REQUIRES: the loop is valid, stable and its controller proper.
void measure_noise(const Loop& loop, const NoiseTrials& trials, double horizon, MeasureRow& row);

/// Measures of one noisy step response: those of the sampled signals, from x(0-) = 0 on.
struct NoisyMeasures {
  double TV_u = 0, TV_y = 0;
  std::array<double, 9> TVm_u{}, TVm_y{};  ///< TV0 .. TV8
  double sigma_ratio = 0;                  ///< sigma of the noise's part of u over that of the noise that was drawn
};
NoisyMeasures noisy_measures(const StepResponse& response, const NoiseAnswer& answer, const Noise& noise);

}  // namespace portrait::reference
