#include "tools/characteristic.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/reference/measure.h"
#include "tools/arguments.h"
#include "tools/general_loop_arguments.h"
#include "tools/simulate_options.h"

namespace portrait::tools {
namespace {

/// "0.2:0.6:9" from, to, how many; or "0.2,0.3,0.5".
std::vector<std::string> values_of(const std::string& text) {
  std::vector<std::string> values;
  const auto split = [&](char separator) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size();) {
      const std::size_t at = std::min(text.find(separator, from), text.size());
      parts.push_back(text.substr(from, at - from));
      from = at + 1;
    }
    return parts;
  };
  if (text.find(':') == std::string::npos) {
    for (const std::string& part : split(',')) values.push_back(number_text(number_argument("--vary", part)));
    return values;
  }
  const std::vector<std::string> parts = split(':');
  if (parts.size() != 3) throw InputError(fmt::format("--vary: \"{}\" is neither FROM:TO:COUNT nor a list", text));
  const double from = number_argument("--vary", parts[0]), to = number_argument("--vary", parts[1]);
  const double count = number_argument("--vary", parts[2]);
  if (!(count >= 2 && count <= 10'000 && count == std::floor(count)) || !std::isfinite(from) || !std::isfinite(to))
    throw InputError(fmt::format(
        "--vary: COUNT is a whole number from 2 to 10000, FROM and TO are finite (it is \"{}\")", text));
  for (int i = 0; i < static_cast<int>(count); ++i)
    values.push_back(fmt::format("{:.15g}", from + (to - from) * i / (count - 1)));
  return values;
}

/// Every {} of the line becomes the value.
SimulateArguments with_value(SimulateArguments a, const std::string& value) {
  bool found = false;
  for (std::string* text : {&a.plant, &a.kappa, &a.tau_i, &a.delta, &a.tau_d, &a.tau_1, &a.tau_f, &a.b, &a.c,
                            &a.prefilter, &a.K, &a.Td, &a.tau_j, &a.pid, &a.gains, &a.controller, &a.weights})
    for (std::size_t at; (at = text->find("{}")) != std::string::npos; found = true) text->replace(at, 2, value);
  if (!found) throw InputError("--vary: there is no {} on the line for it to stand for");
  return a;
}

}  // namespace

std::vector<CharacteristicPoint> points_of(const CharacteristicArguments& a) {
  const Measure speed = measure_argument("--speed", a.speed), effort = measure_argument("--effort", a.effort),
                wobbling = measure_argument("--wobbling", a.wobbling);
  const Horizon horizon = horizon_argument("--horizon", a.loop.horizon);
  std::vector<CharacteristicPoint> points;
  for (const std::string& value : values_of(a.vary)) {
    const GeneralLoop loop = general_loop_argument(with_value(a.loop, value));
    const bool with_output = degree(loop.controller.on_output) <= degree(loop.controller.denominator);
    const auto steps = std::span(reference::kAllSteps).first(with_output ? 3 : 2);
    const reference::Measured found = reference::measure_in_units(loop, horizon, steps).measured;
    const MeasureRow& row = found.measures;
    points.push_back(
        {value, found.status, row[speed], row[effort], row[wobbling], std::pow(row[speed], a.k) * row[effort]});
  }
  return points;
}

void add_characteristic_options(CLI::App& verb, CharacteristicArguments& a) {
  add_loop_options(verb, a.loop);
  verb.add_option("--horizon", a.loop.horizon, "time to simulate, or auto")->capture_default_str();
  verb.add_option("--vary", a.vary, "FROM:TO:COUNT or a list: what {} stands for")->required();
  verb.add_option("--speed", a.speed, "measure of speed")->capture_default_str();
  verb.add_option("--effort", a.effort, "measure of the control effort")->capture_default_str();
  verb.add_option("--wobbling", a.wobbling, "measure of the output's deviation from its ideal shape")
      ->capture_default_str();
}

}  // namespace portrait::tools
