/// A plant as a rule needs it: an integrator with dead time, one lag with dead time, equal lags.
#pragma once

#include "engine/rules/field.h"
#include "engine/rules/pareto_pi.h"
#include "engine/rules/rule.h"

namespace portrait::rules {

/// ipdt as it is; fotd with k = K/T, as its response begins.                                        [Dalen2018 (12)]
/// Throws InputError for other plants.
IntegratingPlant as_integrating(std::string_view rule, const RulePlant& plant);

bool is_ipdt(const RulePlant& plant);
bool is_fotd(const RulePlant& plant);

/// fotd as it is, other plants of real lags by the half rule.
LagDelayPlant as_lag_delay(std::string_view rule, const RulePlant& plant);

/// Throws InputError for a plant without dead time.
void need_dead_time(std::string_view rule, double Td);

/// The loop a search over PI settings simulates. Throws InputError for plants but ipdt and fotd.
PiLoop pi_loop_of(std::string_view rule, const RulePlant& plant);

}  // namespace portrait::rules
