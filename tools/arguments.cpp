#include "tools/arguments.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"

namespace portrait::tools {
namespace {

[[noreturn]] void fail(std::string_view option, const std::string& message) {
  throw InputError(fmt::format("{}: {}", option, message));
}

template <typename Names>
std::vector<std::string_view> words(const Names& names) {
  return {names.begin(), names.end()};
}

struct Assignment {
  std::string name, value;
};

/// "K=2,Td=1" -> (K, 2), (Td, 1)
std::vector<Assignment> assignments(std::string_view option, std::string_view text) {
  std::vector<Assignment> found;
  std::istringstream parts{std::string(text)};
  for (std::string part; std::getline(parts, part, ',');) {
    const auto equals = part.find('=');
    if (equals == std::string::npos) fail(option, fmt::format("\"{}\" is not of the form NAME=NUMBER", part));
    found.push_back({part.substr(0, equals), part.substr(equals + 1)});
  }
  return found;
}

/// "0.4..0.6", or one number for both ends.
Range range_of(std::string_view option, const std::string& text) {
  const auto dots = text.find("..");
  if (dots == std::string::npos) {
    const double only = number_argument(option, text);
    return {only, only};
  }
  return {number_argument(option, text.substr(0, dots)), number_argument(option, text.substr(dots + 2))};
}

}  // namespace

double number_argument(std::string_view option, std::string_view text) {
  const auto number = parse_number(text);
  if (!number) fail(option, fmt::format("\"{}\" is not a number", text));
  return *number;
}

Horizon horizon_argument(std::string_view option, std::string_view text) {
  if (text == "auto") return Horizon::until_settled();
  const auto number = parse_number(text);
  if (!number || !std::isfinite(*number) || *number <= 0)
    fail(option, fmt::format("\"{}\" is neither a number of dead times above 0 nor auto", text));
  if (*number > kHorizonCap) fail(option, fmt::format("at most {} dead times (it is {})", kHorizonCap, text));
  return Horizon::fixed(*number);
}

std::optional<double> sampling_argument(std::string_view option, std::string_view text) {
  if (text.empty()) return std::nullopt;
  const auto number = parse_number(text);
  if (!number || !(*number > 0) || *number > kHorizonCap)
    fail(option, fmt::format("\"{}\" is not a number of dead times above 0 and at most {}", text, kHorizonCap));
  return number;
}

Plant plant_family_argument(std::string_view option, std::string_view text) {
  const auto plant = plant_named(text);
  if (!plant) fail(option, fmt::format("unknown plant \"{}\"{}", text, suggestion(text, words(kPlantNames))));
  if (*plant == Plant::jotd)
    fail(option, "jotd has its place in portrait simulate and in grid files; here it is dipdt, ipdt or fotd");
  return *plant;
}

Measure measure_argument(std::string_view option, std::string_view name) {
  if (const auto measure = measure_named(name)) return *measure;
  std::vector<std::string_view> known;
  for (const Measure m : all_measures()) known.push_back(to_string(m));
  throw InputError(fmt::format("{}: unknown measure \"{}\"{}", option, name, suggestion(name, known)));
}

Prefilter prefilter_argument(std::string_view option, std::string_view text) {
  const auto prefilter = prefilter_named(text);
  if (!prefilter)
    fail(option, fmt::format("unknown prefilter \"{}\"{}", text, suggestion(text, words(kPrefilterNames))));
  return *prefilter;
}

Method method_argument(std::string_view option, std::string_view text) {
  const auto method = method_named(text);
  if (!method) fail(option, fmt::format("unknown method \"{}\"{}", text, suggestion(text, words(kMethodNames))));
  return *method;
}

RealPlant real_plant_argument(std::string_view option, std::string_view text, Plant family) {
  RealPlant plant{.family = family, .K = 1, .Td = 0, .T1 = 0};
  for (const auto& [name, value] : assignments(option, text)) {
    const double number = number_argument(option, value);
    if (name == "K")
      plant.K = number;
    else if (name == "Td")
      plant.Td = number;
    else if (name == lag_name(family))
      plant.T1 = number;
    else if (name == "T1")
      fail(option, fmt::format("T1 belongs to fotd, not to {}", to_string(family)));
    else
      fail(option, fmt::format("unknown name \"{}\"{}", name,
                               suggestion(name, {"K", "Td", lag_name(family).empty() ? "T1" : lag_name(family)})));
  }
  if (const auto reason = why_invalid(plant)) fail(option, *reason);
  return plant;
}

PlantBox uncertain_argument(std::string_view option, std::string_view text, const std::optional<RealPlant>& nominal,
                            Plant family) {
  const RealPlant middle = nominal.value_or(RealPlant{.family = family, .K = 1, .Td = 0, .T1 = 0});
  PlantBox box{middle, {middle.K, middle.K}, {middle.Td, middle.Td}, {middle.T1, middle.T1}};
  const std::vector<Assignment> given = assignments(option, text);
  std::vector<std::string_view> names = {"K", "Td"};
  if (lag_parameter(family)) names.push_back(lag_name(family));
  if (given.empty())
    fail(option, fmt::format("say which of {} vary, as K=0.8..1.2,Td=0.8..1.2", joined(names)));
  for (const auto& [name, value] : given) {
    if (name == "T1" && family != Plant::fotd)
      fail(option, fmt::format("T1 belongs to fotd, not to {}", to_string(family)));
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(option, fmt::format("unknown name \"{}\"{}", name, suggestion(name, names)));
    const Range range = range_of(option, value);
    (name == "K" ? box.K : name == "Td" ? box.Td : box.T1) = range;
    if (!nominal)
      (name == "K"    ? box.nominal.K
       : name == "Td" ? box.nominal.Td
                      : box.nominal.T1) = range.low + 0.5 * (range.high - range.low);
  }
  if (const auto reason = why_invalid(box)) fail(option, *reason);
  return box;
}

StepSizes step_argument(std::string_view option, std::string_view text) {
  StepSizes steps;
  for (const auto& [name, value] : assignments(option, text)) {
    if (name != "w" && name != "d")
      fail(option, fmt::format("unknown step \"{}\": w is the setpoint, d the input disturbance", name));
    const double size = number_argument(option, value);
    if (!std::isfinite(size) || size <= 0)
      fail(option, fmt::format("{} must be finite and above 0 (it is {})", name, value));
    (name == "w" ? steps.w : steps.d) = size;
  }
  return steps;
}

Setting setting_argument(std::string_view option, std::string_view text, const Grid& grid) {
  std::vector<std::pair<Parameter, double>> given;
  for (const auto& [name, value] : assignments(option, text)) {
    const auto parameter = parameter_named(name);
    const std::vector<Parameter> known = parameters_of(grid.family);
    if (!parameter || std::find(known.begin(), known.end(), *parameter) == known.end()) {
      std::vector<std::string_view> names;
      for (const Parameter one : known) names.push_back(to_string(one));
      fail(option, fmt::format("unknown parameter \"{}\"{}", name, suggestion(name, names)));
    }
    given.emplace_back(*parameter, number_argument(option, value));
  }
  const auto is_given = [&](Parameter one) {
    return std::any_of(given.begin(), given.end(), [&](const auto& entry) { return entry.first == one; });
  };
  const bool has_derivative = is_given(Parameter::delta) || is_given(Parameter::tau_d);
  for (const Axis& axis : grid.axes) {
    const bool derivative = axis.parameter() == Parameter::delta || axis.parameter() == Parameter::tau_d;
    if (!is_given(axis.parameter()) && !(derivative && has_derivative))
      fail(option, fmt::format("{} is missing, an axis of the portrait", axis.name()));
  }
  for (const FixedParameter& fixed : grid.fixed) {
    const bool derivative = fixed.parameter == Parameter::delta || fixed.parameter == Parameter::tau_d;
    if (!is_given(fixed.parameter) && !(derivative && has_derivative))
      given.emplace_back(fixed.parameter, fixed.value);
  }
  Setting setting;
  for (const bool last : {false, true})  // tau_d needs kappa
    for (const auto& [parameter, value] : given)
      if ((parameter == Parameter::tau_d) == last) set(setting, parameter, value);
  return setting;
}

}  // namespace portrait::tools
