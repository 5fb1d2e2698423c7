/// Measurement noise: independent values, each held over the sampling time, added to the measured output.
///
/// shape     one value for each instant k Ts, k = 0, 1, ...
/// unit      amplitude in that of the output: for a unit step of the setpoint a part of it
/// result    a value depends on seed and k alone: any thread makes any part
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace portrait {

struct Noise {
  enum class Kind { uniform, gaussian };
  Kind kind = Kind::uniform;
  double amplitude = 0;  ///< uniform: in (-amplitude, amplitude); gaussian: standard deviation
  double sampling = 0;   ///< in units of time of the loop
  std::uint64_t seed = 1;

  /// Of one value.
  double sigma() const;
};

inline constexpr std::array<std::string_view, 2> kNoiseKindNames = {"uniform", "gaussian"};
constexpr std::string_view to_string(Noise::Kind kind) { return kNoiseKindNames[static_cast<std::size_t>(kind)]; }
std::optional<Noise::Kind> noise_kind_named(std::string_view name);

/// The k-th value: a hash of seed and k.
double noise_value(const Noise& noise, std::uint64_t k);

/// The same noise again and again, by seeds that follow each other.
struct NoiseTrials {
  Noise noise;  ///< of the first
  int seeds = 1;
};
/// The i-th of them.
Noise trial(const NoiseTrials& trials, int i);

/// Instants 0, Ts, 2 Ts, ... not after the horizon, but for rounding.
std::size_t samples_up_to(double horizon, double sampling);

/// The spread is the standard deviation of one value, NaN of a single one.
struct MeanAndSpread {
  double mean, spread;
};
MeanAndSpread mean_and_spread(std::span<const double> values);

}  // namespace portrait
