/// portrait tune: a controller by a rule, with the measures of the loop it makes.

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/loop/parameters.h"
#include "engine/rules/catalogue.h"
#include "engine/rules/tuned_loop.h"
#include "engine/sweep/method.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/plant_arguments.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait tune huba2022-qrdp --plant dipdt --K 2 --Td 0.5 --Tf 0.05
  portrait tune dalen2018-pareto --plant ipdt --Ms 1.59
  portrait tune --list

Tunes a controller by a published rule and measures the loop it makes with the plant, both
steps of size one, all in the plant's units. portrait tune RULE --list shows one rule with
its options.)";

struct TuneArguments {
  std::string rule;
  PlantArguments plant;
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
  std::optional<rules::TunedLoop> loop;
  SettingMeasured measured;
};

SettingMeasured measured(const rules::TunedLoop& loop) {
  SettingMeasured result;
  measure_settings(Method::kernel, loop.loop.family, Horizon::until_settled(), std::nullopt,
                   {&loop.loop.setting, 1}, {&result, 1});
  for (const Measure m : all_measures()) result.measures[m] *= scale(m, loop.plant);
  return result;
}

std::vector<Measure> shown_measures() {
  const auto all = all_measures();
  return {all.begin(), all.end()};
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
  if (!a.loop) return json;
  json["settings"] = json_settings(a.loop->loop);
  json["simulate"] = simulate_command(a.loop->loop);
  json["measures"] = json_measures(a.measured.measures, shown_measures());
  json["status"] = to_string(a.measured.status);
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
  std::string text = fmt::format("{} ({})\n{}\n\n", a.rule.name, a.rule.source, rule_plant_text(a.plant));
  text += tuned_text(a.tuned);
  text += "\n  found";
  for (const rules::Finding& f : a.tuned.findings) text += fmt::format("  {} = {}", f.name, short_number(f.value));
  text += "\n";
  if (!a.loop) return text;
  text += fmt::format("  normalised  {}\n  {}\n\n", setting_text(a.loop->loop), to_string(a.measured.status));
  return text + measures_table(a.measured.measures, shown_measures(), "real units, unit steps");
}

int tune(const TuneArguments& a) {
  if (a.list) return list(a);
  if (a.rule.empty()) throw InputError("which rule? portrait tune --list shows them all");
  const rules::Rule& rule = rules::rule_named(a.rule);
  const rules::RulePlant plant = plant_argument(a.plant);
  std::map<std::string, std::string> given;
  for (const auto& [name, text] : a.options)
    if (!text.empty()) given[name] = text;
  const rules::Tuned tuned = rules::tune(rule, plant, given);
  Answer answer{rule, plant, tuned, rules::tuned_loop(plant, tuned), {}};
  if (answer.loop) answer.measured = measured(*answer.loop);
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
  for (const rules::OptionInfo& option : rules::all_options())
    if (verb->get_option_no_throw(fmt::format("--{}", option.name)) == nullptr)
      verb->add_option(fmt::format("--{}", option.name), a->options[std::string(option.name)],
                       std::string(option.meaning));
  verb->add_flag("--list", a->list, "the rules, or one with its options");
  verb->add_flag("--json", a->json, "one JSON object instead of text");
  verb->callback([a, &invocation] { invocation.exit_code = tune(*a); });
}

}  // namespace portrait::tools
