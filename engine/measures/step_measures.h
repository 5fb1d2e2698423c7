/// Where the measures of one step stand in the catalogue, and when its response counts as settled.
#pragma once

#include <array>

#include "engine/measures/catalogue.h"

namespace portrait {

struct StepMeasures {
  Measure IAE, ISE, ITAE, ITSE;
  Measure y_max, u_max;
  std::array<Measure, 4> of_y, of_u;  ///< TV, TV0, TV1, TV2
};

inline constexpr StepMeasures kSetpointMeasures = {
    Measure::IAE_w,
    Measure::ISE_w,
    Measure::ITAE_w,
    Measure::ITSE_w,
    Measure::y_max_w,
    Measure::u_max_w,
    {Measure::TV_yw, Measure::TV0_yw, Measure::TV1_yw, Measure::TV2_yw},
    {Measure::TV_uw, Measure::TV0_uw, Measure::TV1_uw, Measure::TV2_uw}};

inline constexpr StepMeasures kDisturbanceMeasures = {
    Measure::IAE_d,
    Measure::ISE_d,
    Measure::ITAE_d,
    Measure::ITSE_d,
    Measure::y_max_d,
    Measure::u_max_d,
    {Measure::TV_yd, Measure::TV0_yd, Measure::TV1_yd, Measure::TV2_yd},
    {Measure::TV_ud, Measure::TV0_ud, Measure::TV1_ud, Measure::TV2_ud}};

/// Within this part of its largest deviation from rest a signal counts as settled, over the whole last dead time.
inline constexpr double kSettlingBand = 0.01;

}  // namespace portrait
