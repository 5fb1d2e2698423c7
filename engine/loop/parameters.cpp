#include "engine/loop/parameters.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "engine/base/words.h"

namespace portrait {
namespace {

constexpr std::array<ParameterInfo, kParameterCount> kParameters = {{
    {"kappa", "normalised controller gain"},
    {"tau_i", "normalised integral time Ti/Td, inf: no integral action"},
    {"delta", "normalised derivative gain, delta = kappa tau_d"},
    {"tau_d", "normalised derivative time TD/Td"},
    {"tau_1", "normalised plant time constant T1/Td"},
    {"tau_f", "normalised filter time constant Tf/Td"},
    {"b", "prefilter numerator, coefficient of s"},
    {"c", "prefilter numerator, coefficient of s^2"},
    {"tau_j", "normalised time constant of each of the plant's j lags, Tj/Td"},
    {"K_-1", "normalised integral gain"},
    {"K_0", "normalised proportional gain"},
    {"K_1", "normalised gain of the first derivative"},
    {"K_2", "normalised gain of the second derivative"},
    {"K_3", "normalised gain of the third derivative"},
    {"K_4", "normalised gain of the fourth derivative"},
    {"K_5", "normalised gain of the fifth derivative"},
    {"K_6", "normalised gain of the sixth derivative"},
}};

std::string option_name(Parameter parameter) {
  std::string name(to_string(parameter));
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

/// tau_d says nothing that delta does not say.
bool is_printed(Parameter parameter) { return parameter != Parameter::tau_d; }

/// K_k K Td^(integrators - k)
std::string gain_normalisation(Parameter gain, Plant plant) {
  const int power = integrators(plant) - static_cast<int>(*gain_place(gain)) + 1;
  const std::string start = fmt::format("{} K", to_string(gain));
  if (power == 0) return start;
  const std::string Td = std::abs(power) == 1 ? "Td" : fmt::format("Td^{}", std::abs(power));
  return start + (power > 0 ? " " : "/") + Td;
}

/// "0.4,1.3,0.2": from K_-1 up.
std::string gains_text(const Loop& loop) {
  std::vector<std::string> parts;
  for (int i = 0; i <= loop.family.m + 1; ++i)
    parts.push_back(number_text(loop.setting.gains[static_cast<std::size_t>(i)]));
  return fmt::format("{}", fmt::join(parts, ","));
}

}  // namespace

const ParameterInfo& info(Parameter parameter) { return kParameters[static_cast<std::size_t>(parameter)]; }

std::optional<Parameter> parameter_named(std::string_view name) {
  for (std::size_t i = 0; i < kParameterCount; ++i)
    if (kParameters[i].name == name) return static_cast<Parameter>(i);
  return std::nullopt;
}

std::string normalisation(Parameter parameter, Plant plant) {
  const bool dipdt = plant == Plant::dipdt;
  const bool ipdt = plant == Plant::ipdt;
  switch (parameter) {
    case Parameter::kappa:
      return dipdt ? "Kc K Td^2" : ipdt ? "Kc K Td" : "Kc K";
    case Parameter::delta:
      return dipdt ? "Kd K Td" : ipdt ? "Kd K" : "Kd K/Td";
    case Parameter::tau_i:
      return "Ti/Td";
    case Parameter::tau_d:
      return "TD/Td";
    case Parameter::tau_1:
      return "T1/Td";
    case Parameter::tau_f:
      return "Tf/Td";
    case Parameter::b:
      return "b/Td (prefilter full), b (prefilter pi)";
    case Parameter::c:
      return "c/Td^2";
    case Parameter::tau_j:
      return "Tj/Td";
    default:
      return gain_normalisation(parameter, plant);
  }
}

bool applies(Parameter parameter, const LoopFamily& family) {
  if (const auto place = gain_place(parameter))
    return static_cast<int>(*place) <= family.m + 1 && has_gains(family);
  switch (parameter) {
    case Parameter::tau_1:
      return family.plant == Plant::fotd;
    case Parameter::tau_f:
      return family.n >= 1;
    case Parameter::b:
      return family.prefilter != Prefilter::none;
    case Parameter::c:
      return family.prefilter == Prefilter::full;
    case Parameter::tau_j:
      return family.plant == Plant::jotd;
    default:
      return !has_gains(family);
  }
}

std::vector<Parameter> parameters_of(const LoopFamily& family) {
  std::vector<Parameter> found;
  for (std::size_t i = 0; i < kParameterCount; ++i)
    if (applies(static_cast<Parameter>(i), family)) found.push_back(static_cast<Parameter>(i));
  return found;
}

double get(const Setting& setting, Parameter parameter) {
  switch (parameter) {
    case Parameter::kappa:
      return setting.kappa;
    case Parameter::tau_i:
      return setting.tau_i;
    case Parameter::delta:
      return setting.delta;
    case Parameter::tau_d:
      return tau_d(setting);
    case Parameter::tau_1:
      return setting.tau_1;
    case Parameter::tau_f:
      return setting.tau_f;
    case Parameter::b:
      return setting.b;
    case Parameter::c:
      return setting.c;
    case Parameter::tau_j:
      return setting.tau_j;
    default:
      return setting.gains[gain_place(parameter).value()];
  }
}

void set(Setting& setting, Parameter parameter, double value) {
  switch (parameter) {
    case Parameter::kappa:
      setting.kappa = value;
      return;
    case Parameter::tau_i:
      setting.tau_i = value;
      return;
    case Parameter::delta:
      setting.delta = value;
      return;
    case Parameter::tau_d:
      setting.delta = setting.kappa * value;
      return;
    case Parameter::tau_1:
      setting.tau_1 = value;
      return;
    case Parameter::tau_f:
      setting.tau_f = value;
      return;
    case Parameter::b:
      setting.b = value;
      return;
    case Parameter::c:
      setting.c = value;
      return;
    case Parameter::tau_j:
      setting.tau_j = value;
      return;
    default:
      setting.gains[gain_place(parameter).value()] = value;
      return;
  }
}

std::string setting_text(const Loop& loop) {
  std::vector<std::string> parts;
  for (const Parameter p : parameters_of(loop.family))
    if (is_printed(p)) parts.push_back(fmt::format("{}={}", to_string(p), number_text(get(loop.setting, p))));
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string simulate_command(const Loop& loop) {
  std::string command = fmt::format("portrait simulate --plant {} --n {} --prefilter {}",
                                    to_string(loop.family.plant), loop.family.n, to_string(loop.family.prefilter));
  if (loop.family.plant == Plant::jotd) command += fmt::format(" --j {}", loop.family.j);
  if (has_gains(loop.family)) command += " --gains=" + gains_text(loop);
  for (const Parameter p : parameters_of(loop.family))
    if (is_printed(p) && !gain_place(p))
      command += fmt::format(" --{} {}", option_name(p), number_text(get(loop.setting, p)));
  return command;
}

}  // namespace portrait
