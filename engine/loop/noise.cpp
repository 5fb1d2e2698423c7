#include "engine/loop/noise.h"

#include <cmath>
#include <numbers>

namespace portrait {
namespace {

/// SplitMix64: every bit of the result depends on every bit of x.                                      [Steele2014]
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// In (0, 1).
double uniform(std::uint64_t seed, std::uint64_t k) {
  return (static_cast<double>(mixed(mixed(seed) ^ k) >> 11) + 0.5) * 0x1p-53;
}

}  // namespace

std::optional<Noise::Kind> noise_kind_named(std::string_view name) {
  for (const Noise::Kind kind : {Noise::Kind::uniform, Noise::Kind::gaussian})
    if (name == to_string(kind)) return kind;
  return std::nullopt;
}

double Noise::sigma() const { return kind == Kind::uniform ? amplitude / std::sqrt(3.0) : amplitude; }

double noise_value(const Noise& noise, std::uint64_t k) {
  if (noise.kind == Noise::Kind::uniform) return noise.amplitude * (2 * uniform(noise.seed, k) - 1);
  // Box and Muller: two uniform numbers make two normal ones, of which one is used.
  const double radius = std::sqrt(-2 * std::log(uniform(noise.seed, 2 * k)));
  return noise.amplitude * radius * std::cos(2 * std::numbers::pi * uniform(noise.seed, 2 * k + 1));
}

std::size_t samples_up_to(double horizon, double sampling) {
  return static_cast<std::size_t>(std::floor(horizon / sampling * (1 + 1e-12))) + 1;
}

Noise trial(const NoiseTrials& trials, int i) {
  Noise noise = trials.noise;
  noise.seed += static_cast<std::uint64_t>(i);
  return noise;
}

MeanAndSpread mean_and_spread(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double x : values) mean += x / n;
  for (const double x : values) square += (x - mean) * (x - mean);
  return {mean, values.size() > 1 ? std::sqrt(square / (n - 1)) : std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace portrait
