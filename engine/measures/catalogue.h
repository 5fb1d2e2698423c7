/// The measures: one number per setting. Names are public; order here is the order of columns everywhere.
///
/// Suffix _w: unit setpoint step at t = 0. Suffix _d: unit input-disturbance step at t = 0, before the dead
/// time.
/// unit      normalised (dimensionless); `scale` in engine/loop/real_plant.h leads to real units
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

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
};
inline constexpr std::size_t kMeasureCount = 37;

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
  char step;  ///< 'w', 'd', or '-' for a property of the loop alone
};

const MeasureInfo& info(Measure measure);
inline std::string_view to_string(Measure measure) { return info(measure).name; }
std::optional<Measure> measure_named(std::string_view name);

constexpr std::array<Measure, kMeasureCount> all_measures() {
  std::array<Measure, kMeasureCount> all{};
  for (std::size_t i = 0; i < kMeasureCount; ++i) all[i] = static_cast<Measure>(i);
  return all;
}

/// One value per measure; NaN where the measure does not exist for the loop.
class MeasureRow {
 public:
  MeasureRow();
  double& operator[](Measure measure) { return values_[static_cast<std::size_t>(measure)]; }
  double operator[](Measure measure) const { return values_[static_cast<std::size_t>(measure)]; }

 private:
  std::array<double, kMeasureCount> values_;
};

}  // namespace portrait
