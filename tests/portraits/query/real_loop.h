/// A loop in the units of its plant, written down anew: what normalised answers are judged by.
#pragma once

#include <cmath>
#include <string>

#include "engine/loop/general_loop.h"
#include "engine/loop/real_plant.h"
#include "engine/reference/measure.h"
#include "portraits/query/query_units.h"

namespace portrait {

/// K e^{-Td s}/s^2, ... as it stands.
inline GeneralPlant general_plant(const RealPlant& plant) {
  GeneralPlant found{{{plant.K}, {}}, plant.Td};
  if (plant.family == Plant::dipdt) found.rational.denominator = {{0, 1}, {0, 1}};
  if (plant.family == Plant::ipdt) found.rational.denominator = {{0, 1}};
  if (plant.family == Plant::fotd) found.rational.denominator = {{1, plant.T1}};
  return found;
}

inline Polynomial without_leading_zeros(Polynomial p) {
  while (p.size() > 1 && p.back() == 0) p.pop_back();
  return p;
}

inline TransferFunction real_prefilter(const RealController& c, Prefilter prefilter) {
  const auto [Kc, Ti, TD] = c.standard;
  const bool integral = std::isfinite(Ti);
  TransferFunction F;
  Polynomial below;
  if (prefilter == Prefilter::full) {
    F.numerator = {1, c.b, c.c};
    below = integral ? Polynomial{1, Ti, Ti * TD} : Polynomial{1, TD};
  }
  if (prefilter == Prefilter::pi && integral) {
    F.numerator = {1, c.b * Ti};
    below = {1, Ti};
  }
  F.numerator = without_leading_zeros(F.numerator);
  below = without_leading_zeros(below);
  if (below.size() > 1) F.denominator = {below};
  return F;
}

inline GeneralLoop real_loop(const RealController& c, const RealPlant& plant, const LoopFamily& family) {
  const auto [Kc, Ti, TD] = c.standard;
  GeneralLoop loop{general_plant(plant), pid_controller({Kc, Kc / Ti, Kc * TD}, family.n, c.Tf)};
  loop.controller.prefilter = real_prefilter(c, family.prefilter);
  return loop;
}

/// Time alone is measured in dead times while it is simulated, since the simulation takes no other dead time than 1; y and u
/// are those of the real loop. The powers of time and of the steps are put back by the names of the measures.
inline reference::Measured measured_in_real_units(const RealController& controller, const RealPlant& plant,
                                                  const LoopFamily& family, Horizon horizon,
                                                  const StepSizes& steps) {
  const GeneralLoop loop = in_time_unit(real_loop(controller, plant, family), plant.Td);
  reference::Measured found = reference::measure(loop, horizon);
  for (const Measure measure : all_measures()) {
    const std::string name(to_string(measure));
    const double step = name.ends_with("w") ? steps.w : name.ends_with("d") ? steps.d : 1;
    double& value = found.measures[measure];
    if (name.starts_with("IAE")) value *= plant.Td * step;
    if (name.starts_with("ITAE")) value *= plant.Td * plant.Td * step;
    if (name.starts_with("ISE")) value *= plant.Td * step * step;
    if (name.starts_with("ITSE")) value *= plant.Td * plant.Td * step * step;
    if (name.starts_with("TV") || name.starts_with("y_max") || name.starts_with("u_max")) value *= step;
    if (name == "DM") value *= plant.Td;
    if (name.ends_with("omega")) value /= plant.Td;
  }
  return found;
}

}  // namespace portrait
