/// portrait characteristic: speed against effort and wobbling as one parameter runs.          [Huba2021 (52), 3.6]

#include "tools/characteristic_verb.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "tools/characteristic.h"
#include "tools/exit_codes.h"
#include "tools/output.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait characteristic --plant fotd --tau-1 1 --pid standard:Kc={},Ti=1.1,TD=0.5 --n 2 --tau-f 0.1 --vary 0.3,0.4,0.5,0.6
  portrait characteristic --plant ipdt --kappa {} --tau-i 8 --vary 0.2:0.6:9 --speed IAE_d --effort TV1_ud

Simulates a loop, given as for portrait simulate, once for each value of --vary, which stands for every {} on the
line, and prints speed (IAE), effort (TVm of u), wobbling (TVm of y) and J = speed^k effort, as CSV or JSON.)";

std::string csv_number(double x) { return std::isnan(x) ? "" : number_text(x); }

int characteristic(const CharacteristicArguments& a) {
  if (!a.loop.noise.empty()) throw InputError("--noise has no place here: portrait simulate has it");
  const std::vector<CharacteristicPoint> points = points_of(a);
  if (a.loop.json) {
    Json json{
        {"speed", a.speed}, {"effort", a.effort}, {"wobbling", a.wobbling}, {"k", a.k}, {"points", Json::array()}};
    for (const CharacteristicPoint& p : points)
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
  for (const CharacteristicPoint& p : points)
    text += fmt::format("{},{},{},{},{},{}\n", p.value, to_string(p.status), csv_number(p.speed),
                        csv_number(p.effort), csv_number(p.wobbling), csv_number(p.J));
  print_text(text);
  return kDone;
}

}  // namespace

void add_characteristic(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<CharacteristicArguments>();
  CLI::App* verb = add_verb(app, "characteristic", "speed against effort and wobbling as a parameter runs", kHelp);
  add_characteristic_options(*verb, *a);
  verb->add_option("-k,--k", a->k, "exponent of J = speed^k effort")->capture_default_str();
  verb->add_flag("--json", a->loop.json, "one JSON object instead of CSV");
  verb->callback([a, &invocation] { invocation.exit_code = characteristic(*a); });
}

}  // namespace portrait::tools
