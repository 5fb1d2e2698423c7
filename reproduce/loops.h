/// What the makers of tables need of a loop, in a line each.
#pragma once

#include <string>
#include <string_view>

#include "engine/rules/pareto_pi.h"
#include "engine/rules/tuned_loop.h"
#include "reproduce/reproduction.h"

namespace portrait::reproduce {

/// K N(s)/D(s) e^{-Td s} with lags T_i: 1/((1 + T_1 s)(1 + T_2 s)...), and integrators.
rules::RulePlant lag_plant(double K, std::vector<double> lags, double Td, int integrators = 0,
                           Polynomial zeros = {1});

/// Kp + Ki/s + Kd s with n filters; no prefilter.
rules::Tuned pid(const ParallelForm& form, int n = 0, double Tf = 0);
rules::Tuned pi(double Kp, double Ti);

/// Ms of a loop; inf when it is unstable.
double peak_sensitivity(const rules::RulePlant& plant, const rules::Tuned& tuned);

/// The loop of any plant under PI, for searches over its settings.
rules::PiLoop general_pi_loop(const rules::RulePlant& plant, const rules::IntegratingPlant& scale);

/// The number behind "name = " in a row's label: 3 for "m = 3, n = 4" and "m"; 0.5 for "1/2".
double number_in_label(std::string_view label, std::string_view name);

/// A row of numbers without corrections.
std::vector<Computed> row(std::initializer_list<double> values);
std::vector<Computed> row(const std::vector<double>& values, std::size_t columns);

}  // namespace portrait::reproduce
