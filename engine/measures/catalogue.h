/// The measures: one number per setting. Names are public; order here is the order of columns everywhere.
///
/// Suffix _w: unit setpoint step at t = 0. Suffix _d: unit input-disturbance step at t = 0, before the dead
/// time. Suffix _o: unit step of the output itself at t = 0.
/// unit      normalised (dimensionless); `scale` in engine/loop/real_plant.h leads to real units
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace portrait {

enum class Measure {
  IAE_w,
  IAE_d,
  ISE_w,
  ISE_d,
  ITAE_w,
  ITAE_d,
  ITSE_w,
  ITSE_d,
  TV_yw,
  TV0_yw,
  TV1_yw,
  TV2_yw,
  TV_uw,
  TV0_uw,
  TV1_uw,
  TV2_uw,
  TV_yd,
  TV0_yd,
  TV1_yd,
  TV2_yd,
  TV_ud,
  TV0_ud,
  TV1_ud,
  TV2_ud,
  y_max_w,
  u_max_w,
  y_max_d,
  u_max_d,
  Ms,
  Mt,
  Ms_omega,
  Mt_omega,
  GM,
  GM_low,
  PM,
  DM,
  noise_gain,
  // Further measures, kept where they are named.
  TV3_yw,
  TV4_yw,
  TV5_yw,
  TV6_yw,
  TV7_yw,
  TV8_yw,
  TV3_uw,
  TV4_uw,
  TV5_uw,
  TV6_uw,
  TV7_uw,
  TV8_uw,
  TV3_yd,
  TV4_yd,
  TV5_yd,
  TV6_yd,
  TV7_yd,
  TV8_yd,
  TV3_ud,
  TV4_ud,
  TV5_ud,
  TV6_ud,
  TV7_ud,
  TV8_ud,
  IAE_o,
  ISE_o,
  ITAE_o,
  ITSE_o,
  TV_yo,
  TV0_yo,
  TV1_yo,
  TV2_yo,
  TV3_yo,
  TV4_yo,
  TV5_yo,
  TV6_yo,
  TV7_yo,
  TV8_yo,
  TV_uo,
  TV0_uo,
  TV1_uo,
  TV2_uo,
  TV3_uo,
  TV4_uo,
  TV5_uo,
  TV6_uo,
  TV7_uo,
  TV8_uo,
  y_max_o,
  u_max_o,
  DC_yw,
  DC_uw,
  DC_yd,
  DC_ud,
  DC_yo,
  DC_uo,
  // Under noise, over several seeds: engine/loop/noise.h.
  noisy_TV_yw,
  spread_TV_yw,
  noisy_TV0_yw,
  spread_TV0_yw,
  noisy_TV1_yw,
  spread_TV1_yw,
  noisy_TV2_yw,
  spread_TV2_yw,
  noisy_TV_uw,
  spread_TV_uw,
  noisy_TV0_uw,
  spread_TV0_uw,
  noisy_TV1_uw,
  spread_TV1_uw,
  noisy_TV2_uw,
  spread_TV2_uw,
  noisy_TV_yd,
  spread_TV_yd,
  noisy_TV0_yd,
  spread_TV0_yd,
  noisy_TV1_yd,
  spread_TV1_yd,
  noisy_TV2_yd,
  spread_TV2_yd,
  noisy_TV_ud,
  spread_TV_ud,
  noisy_TV0_ud,
  spread_TV0_ud,
  noisy_TV1_ud,
  spread_TV1_ud,
  noisy_TV2_ud,
  spread_TV2_ud,
  sigma_ratio,
  spread_sigma_ratio,
  expected_sigma_ratio,
};
inline constexpr std::size_t kMeasureCount = 128;
/// The first of them, which a portrait keeps when nothing else is asked for.
inline constexpr std::size_t kStandardMeasureCount = 37;

/// What a measure is made of, which fixes its real unit.
enum class Unit {
  one,               ///< a pure number
  output,            ///< unit of y
  output_time,       ///< unit of y times time
  output_time2,      ///< unit of y times time squared
  output2_time,      ///< unit of y squared times time
  output2_time2,     ///< unit of y squared times time squared
  input,             ///< unit of u
  input_per_output,  ///< unit of u per unit of y
  time,              ///< time
  per_time,          ///< radians per time
  degree,            ///< of an angle
};

struct MeasureInfo {
  std::string_view name;        ///< column name in files, expressions and JSON
  std::string_view long_name;   ///< what it is, in words
  std::string_view definition;  ///< its equation
  Unit unit;
  char step;  ///< 'w', 'd', 'o', or '-' for a property of the loop alone
};

const MeasureInfo& info(Measure measure);
inline std::string_view to_string(Measure measure) { return info(measure).name; }
std::optional<Measure> measure_named(std::string_view name);

constexpr std::array<Measure, kMeasureCount> all_measures() {
  std::array<Measure, kMeasureCount> all{};
  for (std::size_t i = 0; i < kMeasureCount; ++i) all[i] = static_cast<Measure>(i);
  return all;
}

constexpr std::array<Measure, kStandardMeasureCount> standard_measures() {
  std::array<Measure, kStandardMeasureCount> standard{};
  for (std::size_t i = 0; i < standard.size(); ++i) standard[i] = static_cast<Measure>(i);
  return standard;
}
constexpr bool is_standard(Measure measure) { return static_cast<std::size_t>(measure) < kStandardMeasureCount; }

inline constexpr std::size_t kNoisyMeasureCount = 35;

/// Those that noise is drawn for: the last of the catalogue. With the mean over seeds always stands its spread, after it.
constexpr std::array<Measure, kNoisyMeasureCount> noisy_measures() {
  std::array<Measure, kNoisyMeasureCount> noisy{};
  for (std::size_t i = 0; i < noisy.size(); ++i)
    noisy[i] = static_cast<Measure>(kMeasureCount - kNoisyMeasureCount + i);
  return noisy;
}
constexpr bool is_noisy(Measure measure) { return measure >= Measure::noisy_TV_yw; }

/// One value per measure; NaN where the measure does not exist for the loop.
class MeasureRow {
 public:
  MeasureRow() { clear(); }
  /// All NaN.
  void clear() {
    values_.fill(std::numeric_limits<double>::quiet_NaN());
    further_.clear();
  }
  double& operator[](Measure measure) {
    const auto i = static_cast<std::size_t>(measure);
    return i < kStandardMeasureCount ? values_[i] : further(i - kStandardMeasureCount);
  }
  double operator[](Measure measure) const {
    const auto i = static_cast<std::size_t>(measure);
    if (i < kStandardMeasureCount) return values_[i];
    return further_.empty() ? std::numeric_limits<double>::quiet_NaN() : further_[i - kStandardMeasureCount];
  }

 private:
  double& further(std::size_t i);

  std::array<double, kStandardMeasureCount> values_;
  std::vector<double> further_;  ///< the others, once one was written: a sweep copies many rows that have none
};

}  // namespace portrait
