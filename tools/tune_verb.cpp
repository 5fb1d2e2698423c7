/// portrait tune: a controller by a rule, with the measures of the loop it makes.

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/loop/parameters.h"
#include "engine/rules/catalogue.h"
#include "engine/rules/tuned_loop.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/plant_arguments.h"
#include "tools/response_argument.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait tune huba2022-qrdp --plant dipdt --K 2 --Td 0.5 --Tf 0.05
  portrait tune dalen2018-pareto --plant ipdt --Ms 1.59
  portrait tune simc-pi --plant fotd --response step.csv
  portrait tune --list

Tunes a controller by a published rule and measures the loop it makes with the plant, both
steps of size one, all in the plant's units. portrait tune RULE --list shows one rule with
its options. With --response the plant comes from a recorded response (CSV of t, u, y): fitted
for --plant dipdt, ipdt or fotd, its areas for self-regulating or integrating, its steepest
tangent for reaction-curve; without RULE only that is shown.)";

struct TuneArguments {
  std::string rule;
  PlantArguments plant;
  ResponseArguments response;
  std::map<std::string, std::string> options;  ///< of all rules; empty: not given
  bool list = false, json = false;
};

// ---------------------------------------------------------------- the list

Json json_rule(const rules::Rule& rule) {
  Json options = Json::array();
  for (const rules::OptionInfo& option : rule.options)
    options.push_back({{"name", option.name},
                       {"meaning", option.meaning},
                       {"usually", option.usually.empty() ? Json(nullptr) : Json(option.usually)}});
  return {{"name", rule.name}, {"controller", rule.controller}, {"plants", rule.plants},
          {"line", rule.line}, {"source", rule.source},         {"options", options}};
}

std::string rule_text(const rules::Rule& rule) {
  std::string text = fmt::format("{}  {}\n  {}\n  plants   {}\n  source   {}\n", rule.name, rule.controller,
                                 rule.line, rule.plants, rule.source);
  for (const rules::OptionInfo& option : rule.options)
    text += fmt::format("  --{:<10} {}{}\n", option.name, option.meaning,
                        option.usually.empty() ? "" : fmt::format(" (default {})", option.usually));
  return text;
}

int list(const TuneArguments& a) {
  std::vector<rules::Rule> shown;
  for (const rules::Rule& rule : rules::catalogue())
    if (a.rule.empty() || &rule == &rules::rule_named(a.rule)) shown.push_back(rule);
  if (a.json) {
    Json json = Json::array();
    for (const rules::Rule& rule : shown) json.push_back(json_rule(rule));
    print_json(json);
    return kDone;
  }
  std::string text;
  if (shown.size() == 1) {
    text = rule_text(shown.front());
  } else {
    for (const rules::Rule& rule : shown)
      text += fmt::format("{:<20} {:<24} {}; {}\n", rule.name, rule.controller, rule.line, rule.plants);
  }
  print_text(text);
  return kDone;
}

// ---------------------------------------------------------------- the loop

/// A rule's answer and what was measured of its loop, in the plant's units.
struct Answer {
  const rules::Rule& rule;
  const rules::RulePlant& plant;
  const rules::Tuned& tuned;
  const RecordedPlant* recorded;                 ///< nullptr: the plant was given
  std::optional<rules::TunedLoop> loop;          ///< where a family of portraits has it
  std::optional<rules::TunedMeasures> measured;  ///< nothing when the plant is known by its areas alone
};

std::vector<Measure> shown_measures() {
  const auto shown = standard_measures();
  return {shown.begin(), shown.end()};
}

// ---------------------------------------------------------------- printing

RealController real_controller(const rules::Tuned& t) {
  return {.standard = *t.pid, .Tf = t.Tf, .b = t.b, .c = t.c};
}

LoopFamily printed_family(const rules::Tuned& t) {
  return {.plant = Plant::dipdt, .n = t.n, .prefilter = t.prefilter};
}

Json highest_first(const Polynomial& p) {
  Json list = Json::array();
  for (auto i = p.rbegin(); i != p.rend(); ++i) list.push_back(json_number(*i));
  return list;
}

Json json_quotient(const rules::Quotient& q) {
  return {{"numerator", highest_first(q.numerator)}, {"denominator", highest_first(q.denominator)}};
}

Json json_tuned(const rules::Tuned& t) {
  Json json = t.pid ? json_controller(real_controller(t), printed_family(t)) : Json::object();
  if (!t.pid) json["filter"] = {{"n", t.n}, {"Tf", t.Tf}};
  json["transfer_function"] = json_quotient(t.controller);
  if (t.other_prefilter) json["prefilter"] = json_quotient(*t.other_prefilter);
  return json;
}

Json json_record(const RecordedPlant& recorded) {
  Json json = Json::object();
  for (const rules::Finding& f : recorded.found) json[f.name] = json_number(f.value);
  json["remarks"] = recorded.remarks;
  return json;
}

std::string record_text(const RecordedPlant& recorded) {
  std::string text = "record";
  for (const rules::Finding& f : recorded.found) text += fmt::format("  {} = {}", f.name, short_number(f.value));
  return text + "\n";
}

Json json_answer(const Answer& a) {
  Json findings = Json::object();
  for (const rules::Finding& f : a.tuned.findings) findings[f.name] = json_number(f.value);
  Json json{{"rule", a.rule.name},
            {"source", a.rule.source},
            {"plant", {{"name", a.plant.name}, {"K", a.plant.K}, {"Td", a.plant.Td}}},
            {"controller", json_tuned(a.tuned)},
            {"found", findings},
            {"settings", nullptr},
            {"measures", nullptr},
            {"status", to_string(Status::not_computed)}};
  if (a.recorded) json["record"] = json_record(*a.recorded);
  if (a.loop) json["settings"] = json_settings(a.loop->loop), json["simulate"] = simulate_command(a.loop->loop);
  if (!a.measured) return json;
  json["measures"] = json_measures(a.measured->measures, shown_measures());
  json["status"] = to_string(a.measured->status);
  return json;
}

/// "3 s^2 + 2 s + 1"
std::string polynomial_text(const Polynomial& p) {
  std::string text;
  for (std::size_t i = p.size(); i-- > 0;) {
    if (p[i] == 0) continue;
    const std::string power = i == 0 ? "" : i == 1 ? " s" : fmt::format(" s^{}", i);
    text += text.empty() ? short_number(p[i]) : (p[i] < 0 ? " - " : " + ") + short_number(std::abs(p[i]));
    text += power;
  }
  return text.empty() ? "0" : text;
}

std::string quotient_text(const rules::Quotient& q) {
  return fmt::format("({})/({})", polynomial_text(q.numerator), polynomial_text(q.denominator));
}

std::string tuned_text(const rules::Tuned& t) {
  std::string text;
  if (t.pid && !t.other_prefilter) return controller_text(real_controller(t), printed_family(t));
  text = fmt::format("  {:<10} {}\n", "controller", quotient_text(t.controller));
  if (t.n > 0) text += fmt::format("  {:<10} 1/(Tf s + 1)^{}, Tf = {}\n", "filter", t.n, short_number(t.Tf));
  text += fmt::format("  {:<10} {}\n", "prefilter", t.other_prefilter ? quotient_text(*t.other_prefilter) : "1");
  return text;
}

std::string answer_text(const Answer& a) {
  std::string text = fmt::format("{} ({})\n{}\n", a.rule.name, a.rule.source, rule_plant_text(a.plant));
  text += (a.recorded ? record_text(*a.recorded) : "") + "\n";
  text += tuned_text(a.tuned);
  text += "\n  found";
  for (const rules::Finding& f : a.tuned.findings) text += fmt::format("  {} = {}", f.name, short_number(f.value));
  text += "\n";
  if (a.loop) text += fmt::format("  normalised  {}\n", setting_text(a.loop->loop));
  if (!a.measured) return text;
  text += fmt::format("  {}\n\n", to_string(a.measured->status));
  return text + measures_table(a.measured->measures, shown_measures(), "real units, unit steps");
}

std::optional<RecordedPlant> recorded_or_not(const TuneArguments& a) {
  if (a.response.file.empty()) return std::nullopt;
  if (!a.plant.K.empty() || !a.plant.Td.empty() || !a.plant.T1.empty())
    throw InputError("--K, --Td and --T1 have no place here: the plant comes from --response");
  if (a.plant.plant.empty())
    throw InputError(
        "--plant is missing: dipdt, ipdt or fotd to fit one, self-regulating or integrating for areas, or "
        "reaction-curve");
  RecordedPlant made = recorded_plant(a.response, a.plant.plant);
  for (const std::string& remark : made.remarks) print_message("note: " + remark);
  return made;
}

int show_record(const RecordedPlant& recorded, bool json) {
  json ? print_json(json_record(recorded)) : print_text(record_text(recorded));
  return kDone;
}

int tune(const TuneArguments& a) {
  if (a.list) return list(a);
  if (a.rule.empty() && a.response.file.empty())
    throw InputError("which rule? portrait tune --list shows them all");
  const std::optional<RecordedPlant> recorded = recorded_or_not(a);
  if (a.rule.empty()) return show_record(*recorded, a.json);
  const rules::Rule& rule = rules::rule_named(a.rule);
  const rules::RulePlant plant = recorded ? recorded->plant : plant_argument(a.plant);
  std::map<std::string, std::string> given;
  for (const auto& [name, text] : a.options)
    if (!text.empty()) given[name] = text;
  const rules::Tuned tuned = rules::tune(rule, plant, given);
  Answer answer{rule, plant, tuned, recorded ? &*recorded : nullptr, rules::tuned_loop(plant, tuned), {}};
  try {
    if (!plant.measured) answer.measured = rules::measured(plant, tuned);
  } catch (const std::runtime_error& error) {
    print_message(fmt::format("note: the loop was not measured: {}", error.what()));
  }
  if (a.json)
    print_json(json_answer(answer));
  else
    print_text(answer_text(answer));
  return kDone;
}

}  // namespace

void add_tune(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<TuneArguments>();
  CLI::App* verb = add_verb(app, "tune", "a controller by a published tuning rule, and its loop", kHelp);
  verb->add_option("rule", a->rule, "name of the rule");
  add_plant_options(*verb, a->plant);
  add_response_options(*verb, a->response);
  for (const rules::OptionInfo& option : rules::all_options())
    if (verb->get_option_no_throw(fmt::format("--{}", option.name)) == nullptr)
      verb->add_option(fmt::format("--{}", option.name), a->options[std::string(option.name)],
                       std::string(option.meaning));
  verb->add_flag("--list", a->list, "the rules, or one with its options");
  verb->add_flag("--json", a->json, "one JSON object instead of text");
  verb->callback([a, &invocation] { invocation.exit_code = tune(*a); });
}

}  // namespace portrait::tools
