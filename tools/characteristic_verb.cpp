/// portrait characteristic: speed against effort and wobbling as one parameter runs.          [Huba2021 (52), 3.6]

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/reference/measure.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/general_loop_arguments.h"
#include "tools/output.h"
#include "tools/simulate_options.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait characteristic --plant fotd --tau-1 1 --pid standard:Kc={},Ti=1.1,TD=0.5 --n 2 --tau-f 0.1 --vary 0.3,0.4,0.5,0.6
  portrait characteristic --plant ipdt --kappa {} --tau-i 8 --vary 0.2:0.6:9 --speed IAE_d --effort TV1_ud

Simulates a loop, given as for portrait simulate, once for each value of --vary, which stands for every {} on the
line, and prints speed (IAE), effort (TVm of u), wobbling (TVm of y) and J = speed^k effort, as CSV or JSON.)";

struct CharacteristicArguments {
  SimulateArguments loop;
  std::string vary, speed = "IAE_d", effort = "TV1_ud", wobbling = "TV1_yd";
  double k = 1;
};

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

Measure measure_argument(const char* option, const std::string& name) {
  if (const auto measure = measure_named(name)) return *measure;
  std::vector<std::string_view> known;
  for (const Measure m : all_measures()) known.push_back(to_string(m));
  throw InputError(fmt::format("{}: unknown measure \"{}\"{}", option, name, suggestion(name, known)));
}

struct Point {
  std::string value;
  Status status;
  double speed, effort, wobbling, J;
};

std::vector<Point> points_of(const CharacteristicArguments& a) {
  const Measure speed = measure_argument("--speed", a.speed), effort = measure_argument("--effort", a.effort),
                wobbling = measure_argument("--wobbling", a.wobbling);
  const Horizon horizon = horizon_argument("--horizon", a.loop.horizon);
  std::vector<Point> points;
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

std::string csv_number(double x) { return std::isnan(x) ? "" : number_text(x); }

int characteristic(const CharacteristicArguments& a) {
  if (!a.loop.noise.empty()) throw InputError("--noise has no place here: portrait simulate has it");
  const std::vector<Point> points = points_of(a);
  if (a.loop.json) {
    Json json{
        {"speed", a.speed}, {"effort", a.effort}, {"wobbling", a.wobbling}, {"k", a.k}, {"points", Json::array()}};
    for (const Point& p : points)
      json["points"].push_back({{"value", json_number(*parse_number(p.value))},
                                {"status", to_string(p.status)},
                                {a.speed, json_number(p.speed)},
                                {a.effort, json_number(p.effort)},
                                {a.wobbling, json_number(p.wobbling)},
                                {"J", json_number(p.J)}});
    print_json(json);
    return kDone;
  }
  std::string text = fmt::format("value,status,{},{},{},J\n", a.speed, a.effort, a.wobbling);
  for (const Point& p : points)
    text += fmt::format("{},{},{},{},{},{}\n", p.value, to_string(p.status), csv_number(p.speed),
                        csv_number(p.effort), csv_number(p.wobbling), csv_number(p.J));
  print_text(text);
  return kDone;
}

}  // namespace

void add_characteristic(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<CharacteristicArguments>();
  CLI::App* verb = add_verb(app, "characteristic", "speed against effort and wobbling as a parameter runs", kHelp);
  add_loop_options(*verb, a->loop);
  verb->add_option("--horizon", a->loop.horizon, "time to simulate, or auto")->capture_default_str();
  verb->add_option("--vary", a->vary, "FROM:TO:COUNT or a list: what {} stands for")->required();
  verb->add_option("--speed", a->speed, "measure of speed")->capture_default_str();
  verb->add_option("--effort", a->effort, "measure of the control effort")->capture_default_str();
  verb->add_option("--wobbling", a->wobbling, "measure of the output's deviation from its ideal shape")
      ->capture_default_str();
  verb->add_option("-k,--k", a->k, "exponent of J = speed^k effort")->capture_default_str();
  verb->add_flag("--json", a->loop.json, "one JSON object instead of CSV");
  verb->callback([a, &invocation] { invocation.exit_code = characteristic(*a); });
}

}  // namespace portrait::tools
