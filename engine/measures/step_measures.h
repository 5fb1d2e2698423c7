/// Where the measures of one step stand in the catalogue, and when its response counts as settled.
#pragma once

#include <array>

#include "engine/measures/catalogue.h"

namespace portrait {

struct StepMeasures {
  Measure IAE, ISE, ITAE, ITSE;
  Measure y_max, u_max;
  std::array<Measure, 4> of_y, of_u;            ///< TV, TV0, TV1, TV2
  std::array<Measure, 6> further_y, further_u;  ///< TV3 .. TV8
  Measure class_y, class_u;
};

inline constexpr StepMeasures kSetpointMeasures = {
    Measure::IAE_w,
    Measure::ISE_w,
    Measure::ITAE_w,
    Measure::ITSE_w,
    Measure::y_max_w,
    Measure::u_max_w,
    {Measure::TV_yw, Measure::TV0_yw, Measure::TV1_yw, Measure::TV2_yw},
    {Measure::TV_uw, Measure::TV0_uw, Measure::TV1_uw, Measure::TV2_uw},
    {Measure::TV3_yw, Measure::TV4_yw, Measure::TV5_yw, Measure::TV6_yw, Measure::TV7_yw, Measure::TV8_yw},
    {Measure::TV3_uw, Measure::TV4_uw, Measure::TV5_uw, Measure::TV6_uw, Measure::TV7_uw, Measure::TV8_uw},
    Measure::DC_yw,
    Measure::DC_uw};

inline constexpr StepMeasures kDisturbanceMeasures = {
    Measure::IAE_d,
    Measure::ISE_d,
    Measure::ITAE_d,
    Measure::ITSE_d,
    Measure::y_max_d,
    Measure::u_max_d,
    {Measure::TV_yd, Measure::TV0_yd, Measure::TV1_yd, Measure::TV2_yd},
    {Measure::TV_ud, Measure::TV0_ud, Measure::TV1_ud, Measure::TV2_ud},
    {Measure::TV3_yd, Measure::TV4_yd, Measure::TV5_yd, Measure::TV6_yd, Measure::TV7_yd, Measure::TV8_yd},
    {Measure::TV3_ud, Measure::TV4_ud, Measure::TV5_ud, Measure::TV6_ud, Measure::TV7_ud, Measure::TV8_ud},
    Measure::DC_yd,
    Measure::DC_ud};

inline constexpr StepMeasures kOutputStepMeasures = {
    Measure::IAE_o,
    Measure::ISE_o,
    Measure::ITAE_o,
    Measure::ITSE_o,
    Measure::y_max_o,
    Measure::u_max_o,
    {Measure::TV_yo, Measure::TV0_yo, Measure::TV1_yo, Measure::TV2_yo},
    {Measure::TV_uo, Measure::TV0_uo, Measure::TV1_uo, Measure::TV2_uo},
    {Measure::TV3_yo, Measure::TV4_yo, Measure::TV5_yo, Measure::TV6_yo, Measure::TV7_yo, Measure::TV8_yo},
    {Measure::TV3_uo, Measure::TV4_uo, Measure::TV5_uo, Measure::TV6_uo, Measure::TV7_uo, Measure::TV8_uo},
    Measure::DC_yo,
    Measure::DC_uo};

/// Within this part of its largest deviation from rest a signal counts as settled, over the whole last dead time.
inline constexpr double kSettlingBand = 0.01;

}  // namespace portrait
