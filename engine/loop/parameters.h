/// The normalised parameters by name: the columns of a setting, the axes of a grid.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/loop/loop.h"

namespace portrait {

/// In the order in which a setting is printed. tau_d is delta seen through kappa: delta = kappa tau_d.
enum class Parameter {
  kappa,
  tau_i,
  delta,
  tau_d,
  tau_1,
  tau_f,
  b,
  c,
  tau_j,
  K_m1,
  K_0,
  K_1,
  K_2,
  K_3,
  K_4,
  K_5,
  K_6
};
inline constexpr std::size_t kParameterCount = 17;

/// Of a gain K_k the place in `Setting::gains`, k + 1; nothing for the other parameters.
constexpr std::optional<std::size_t> gain_place(Parameter parameter) {
  if (parameter < Parameter::K_m1) return std::nullopt;
  return static_cast<std::size_t>(parameter) - static_cast<std::size_t>(Parameter::K_m1);
}

struct ParameterInfo {
  std::string_view name;       ///< as users write it
  std::string_view long_name;  ///< with the normalisation, dimensionless
};

const ParameterInfo& info(Parameter parameter);
inline std::string_view to_string(Parameter parameter) { return info(parameter).name; }
std::optional<Parameter> parameter_named(std::string_view name);

/// Kc K Td^2 for dipdt, Kc K Td for ipdt, ...: what the parameter is in the quantities of a real plant.
std::string normalisation(Parameter parameter, Plant plant);

/// Whether a loop of this family has the parameter: tau_1 only fotd, tau_j only jotd, tau_f only n >= 1, b and c only with a
/// prefilter that has them, kappa, tau_i and delta or else the gains up to K_m.
bool applies(Parameter parameter, const LoopFamily& family);

/// The parameters of this family, in printing order, tau_d among them.
std::vector<Parameter> parameters_of(const LoopFamily& family);

double get(const Setting& setting, Parameter parameter);

/// REQUIRES: for tau_d, that kappa was set before.
void set(Setting& setting, Parameter parameter, double value);

/// "kappa=0.24 tau_i=8 delta=0.7".
std::string setting_text(const Loop& loop);
/// The command that runs this one loop: "portrait simulate --plant dipdt --kappa 0.24 ...".
std::string simulate_command(const Loop& loop);

}  // namespace portrait
