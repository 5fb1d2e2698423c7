#include "engine/rules/plants.h"

#include <fmt/format.h>

#include "engine/rules/half_rule.h"

namespace portrait::rules {

bool is_ipdt(const RulePlant& plant) {
  return plant.integrators == 1 && plant.zeros.size() == 1 && plant.poles.empty();
}

bool is_fotd(const RulePlant& plant) {
  return plant.integrators == 0 && plant.zeros.size() == 1 && plant.poles.size() == 1 &&
         plant.poles[0].size() == 2 && plant.poles[0][1] > 0;
}

IntegratingPlant as_integrating(std::string_view rule, const RulePlant& plant) {
  if (is_ipdt(plant)) return {plant.K, plant.Td};
  if (is_fotd(plant)) return {plant.K / plant.poles[0][1], plant.Td};
  fail_precondition(rule, fmt::format("it needs an ipdt or a fotd plant, and \"{}\" is neither", plant.name));
}

LagDelayPlant as_lag_delay(std::string_view rule, const RulePlant& plant) {
  const auto lags = real_lags(plant);
  if (plant.integrators != 0 || !lags || lags->empty())
    fail_precondition(
        rule,
        fmt::format("it needs a plant of real lags without zeros or integrators, and \"{}\" is none", plant.name));
  const FewLags one = half_rule(*lags, plant.Td, 1);
  return {plant.K, one.lags[0], one.dead_time};
}

void need_dead_time(std::string_view rule, double Td) {
  if (!(Td > 0)) fail_precondition(rule, "it needs a dead time above 0");
}

PiLoop pi_loop_of(std::string_view rule, const RulePlant& plant) {
  need_dead_time(rule, plant.Td);
  if (is_ipdt(plant)) return pi_loop(IntegratingPlant{plant.K, plant.Td});
  if (is_fotd(plant)) return pi_loop(LagDelayPlant{plant.K, plant.poles[0][1], plant.Td});
  fail_precondition(rule, fmt::format("it needs an ipdt or a fotd plant, and \"{}\" is neither", plant.name));
}

}  // namespace portrait::rules
