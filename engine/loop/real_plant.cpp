#include "engine/loop/real_plant.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait {
namespace {

std::string must_be(std::string_view name, double value, std::string_view rule) {
  return fmt::format("{} must be {} (it is {})", name, rule, number_text(value));
}

/// The prefilter `pi` writes its numerator 1 + b tau_i s: there b has no unit.
double unit_of_b(Prefilter prefilter, double Td) { return prefilter == Prefilter::full ? Td : 1; }

}  // namespace

std::optional<std::string> why_invalid(const RealPlant& plant) {
  if (!std::isfinite(plant.K) || plant.K == 0) return must_be("K", plant.K, "finite and not 0");
  if (!std::isfinite(plant.Td) || plant.Td <= 0) return must_be("Td", plant.Td, "finite and above 0");
  if (lag_parameter(plant.family) && !(std::isfinite(plant.T1) && plant.T1 > 0))
    return must_be(lag_name(plant.family), plant.T1, "finite and above 0");
  return std::nullopt;
}

double input_gain(const RealPlant& plant) { return plant.K * std::pow(plant.Td, integrators(plant.family)); }

double scale(Measure measure, const RealPlant& plant) {
  return scale(measure, Units{.time = plant.Td, .gain = input_gain(plant)});
}

RealController controller_for(const Loop& loop, const RealPlant& plant) {
  const Setting& s = loop.setting;
  return {.standard = {.Kc = s.kappa / input_gain(plant), .Ti = s.tau_i * plant.Td, .TD = tau_d(s) * plant.Td},
          .Tf = s.tau_f * plant.Td,
          .b = s.b * unit_of_b(loop.family.prefilter, plant.Td),
          .c = s.c * plant.Td * plant.Td};
}

Setting normalised(const RealController& controller, const RealPlant& plant, const LoopFamily& family) {
  const double Td = plant.Td;
  const double kappa = controller.standard.Kc * input_gain(plant), lag = plant.T1 / Td;
  return {.kappa = kappa,
          .tau_i = controller.standard.Ti / Td,
          .delta = kappa * controller.standard.TD / Td,
          .tau_1 = plant.family == Plant::fotd ? lag : 0,
          .tau_f = controller.Tf / Td,
          .b = controller.b / unit_of_b(family.prefilter, Td),
          .c = controller.c / (Td * Td),
          .tau_j = plant.family == Plant::jotd ? lag : 0};
}

}  // namespace portrait
