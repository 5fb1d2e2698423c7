/// From normalised numbers to a real plant's units and back.
///
/// With g = K Td^2 (dipdt), K Td (ipdt), K (fotd), the output that one unit of input builds up:
///
///     t = Td t'        Kc = kappa/g     Ti = tau_i Td     Kd = delta Td/g     Tf = tau_f Td     T1 = tau_1 Td
///     setpoint step 1:     y = y'       u = u'/g
///     disturbance step 1:  y = g y'     u = u'
///
/// unit      time in that of Td; gain K in output per input (and per time or time^2 for integrating plants)
#pragma once

#include <optional>

#include "engine/loop/forms.h"
#include "engine/loop/loop.h"
#include "engine/loop/parameters.h"
#include "engine/loop/units.h"
#include "engine/measures/catalogue.h"

namespace portrait {

/// K e^{-Td s}/s^2, K e^{-Td s}/s or K e^{-Td s}/(T1 s + 1), jotd.
struct RealPlant {
  Plant family = Plant::dipdt;
  double K = 1;
  double Td = 1;
  double T1 = 0;  ///< of fotd; of jotd each lag's Tj
};

/// How the time constant of its lags is called: T1, Tj, or nothing.
constexpr std::string_view lag_name(Plant plant) {
  return plant == Plant::fotd ? "T1" : plant == Plant::jotd ? "Tj" : "";
}
/// The same among the normalised parameters.
constexpr std::optional<Parameter> lag_parameter(Plant plant) {
  if (plant == Plant::fotd) return Parameter::tau_1;
  if (plant == Plant::jotd) return Parameter::tau_j;
  return std::nullopt;
}

/// Why such a plant cannot be, or nothing.
std::optional<std::string> why_invalid(const RealPlant& plant);

/// g of the file's head.
double input_gain(const RealPlant& plant);

/// A normalised measure times this is the measure of the real loop, for steps of size one in real units.
double scale(Measure measure, const RealPlant& plant);

/// Controller, filter and prefilter in real units.
struct RealController {
  StandardForm standard;
  double Tf;  ///< of each of the n filter poles
  double b;   ///< prefilter full: time; prefilter pi: a pure number
  double c;   ///< time^2
};

RealController controller_for(const Loop& loop, const RealPlant& plant);

/// The inverse of `controller_for`: the setting of a real controller on a real plant.
Setting normalised(const RealController& controller, const RealPlant& plant, const LoopFamily& family);

}  // namespace portrait
