/// portrait query: the best settings of a portrait under constraints, in normalised or real units.

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/loop/parameters.h"
#include "portraits/query/query.h"
#include "portraits/reader.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait query huba.h5 --minimize 'IAE_w + IAE_d' --where 'TV2_ud <= 0.1' --where 'delta == 0.35'
  portrait query huba.h5 --minimize IAE_d --where 'Ms <= 2' --plant K=2,Td=0.5 --top 5

Finds the setting of a portrait with the smallest value of an expression among those that
meet every constraint. Expressions are over the portrait's measures (IAE_w, TV2_ud, Ms, ...)
and its axes (kappa, tau_i, ...) with + - * / ^, parentheses, abs, min, max, sqrt, log, exp.
With --plant all measures, and so the bounds on them, are in real units; names of axes keep
meaning normalised values.)";

struct QueryArguments {
  std::string file, minimize, plant;
  std::vector<std::string> where;
  std::size_t top = 1;
  bool include_not_settled = false, json = false, csv = false;
};

/// Everything that the printing below needs to know.
struct Asked {
  const Grid& grid;
  const Question& question;
  const Answer& answer;
};

Question question_from(const QueryArguments& a, const Grid& grid) {
  Question question{.minimize = parse_expression({"--minimize", a.minimize}),
                    .where = {},
                    .top = a.top,
                    .plant = std::nullopt,
                    .include_not_settled = a.include_not_settled};
  for (const std::string& text : a.where) question.where.push_back(parse_constraint({"--where", text}));
  if (!a.plant.empty()) question.plant = real_plant_argument("--plant", a.plant, grid.family.plant);
  return question;
}

Loop loop_of(const Asked& asked, const Found& found) { return {asked.grid.family, found.setting}; }

// ---------------------------------------------------------------- JSON

Json json_found(const Asked& asked, const Found& found) {
  Json json{{"settings", json_settings(loop_of(asked, found))},
            {"objective", json_number(found.objective)},
            {"measures", json_measures(found.measures, asked.grid.measures)},
            {"status", to_string(found.status)}};
  if (asked.question.plant)
    json["controller"] =
        json_controller(controller_for(loop_of(asked, found), *asked.question.plant), asked.grid.family);
  return json;
}

Json json_active(const Asked& asked) {
  Json list = Json::array();
  for (const ActiveConstraint& active : asked.answer.active)
    list.push_back({{"constraint", asked.question.where[active.constraint].text()},
                    {"objective_without", json_number(active.optimum.objective)},
                    {"settings_without", json_settings(loop_of(asked, active.optimum))}});
  return list;
}

Json json_plant(const RealPlant& plant) {
  Json json{{"family", to_string(plant.family)}, {"K", plant.K}, {"Td", plant.Td}};
  if (plant.family == Plant::fotd) json["T1"] = plant.T1;
  return json;
}

Json json_excluded(const Asked& asked) {
  Json list = Json::array();
  for (std::size_t i = 0; i < asked.question.where.size(); ++i)
    list.push_back({{"constraint", asked.question.where[i].text()}, {"excluded", asked.answer.excluded[i]}});
  return list;
}

Json json_near_miss(const Asked& asked) {
  const auto& miss = asked.answer.near_miss;
  if (!miss) return nullptr;
  Json violations = Json::array();
  for (const Violation& v : miss->violations)
    violations.push_back({{"constraint", asked.question.where[v.constraint].text()},
                          {"value", json_number(v.left)},
                          {"bound", json_number(v.right)}});
  return {{"settings", json_settings(loop_of(asked, miss->found))}, {"violations", violations}};
}

void print_as_json(const Asked& asked) {
  const Answer& answer = asked.answer;
  Json top = Json::array();
  for (const Found& found : answer.top) top.push_back(json_found(asked, found));
  Json json{{"optimum", answer.top.empty() ? Json(nullptr) : top.front()},
            {"active", json_active(asked)},
            {"top", top},
            {"admissible", answer.admissible},
            {"total", answer.total},
            {"left_out",
             {{"unstable", answer.left_out.unstable},
              {"not_settled", answer.left_out.not_settled},
              {"not_computed", answer.left_out.not_computed},
              {"objective_missing", answer.left_out.objective_missing}}},
            {"excluded", json_excluded(asked)},
            {"units", asked.question.plant ? "real" : "normalised"}};
  if (asked.question.plant) json["plant"] = json_plant(*asked.question.plant);
  if (answer.top.empty()) json["least_violation"] = json_near_miss(asked);
  print_json(json);
}

// ---------------------------------------------------------------- CSV

void print_as_csv(const Asked& asked) {
  std::string text;
  for (const Parameter p : parameters_of(asked.grid.family)) text += fmt::format("{},", to_string(p));
  text += "objective,status";
  for (const Measure m : asked.grid.measures) text += fmt::format(",{}", to_string(m));
  text += "\n";
  for (const Found& found : asked.answer.top) {
    for (const Parameter p : parameters_of(asked.grid.family)) text += number_text(get(found.setting, p)) + ",";
    text += fmt::format("{},{}", number_text(found.objective), to_string(found.status));
    for (const Measure m : asked.grid.measures) text += "," + number_text(found.measures[m]);
    text += "\n";
  }
  print_text(text);
}

// ---------------------------------------------------------------- tables

std::string share_text(const Answer& answer) {
  const LeftOut& out = answer.left_out;
  std::string text = fmt::format("{} of {} settings are admissible", answer.admissible, answer.total);
  std::vector<std::string> reasons;
  if (out.unstable > 0) reasons.push_back(fmt::format("{} unstable", out.unstable));
  if (out.not_settled > 0) reasons.push_back(fmt::format("{} not settled at the horizon", out.not_settled));
  if (out.not_computed > 0) reasons.push_back(fmt::format("{} not computed", out.not_computed));
  if (out.objective_missing > 0) reasons.push_back(fmt::format("{} without objective", out.objective_missing));
  if (!reasons.empty()) text += fmt::format(" (left out: {})", fmt::join(reasons, ", "));
  return text + "\n";
}

std::string active_text(const Asked& asked) {
  if (asked.question.where.empty()) return "";
  if (asked.answer.active.empty())
    return "no constraint is active: the optimum is the same without any one of them\n";
  std::string text;
  for (const ActiveConstraint& active : asked.answer.active)
    text += fmt::format("active: {}; without it {} at {}\n", asked.question.where[active.constraint].text(),
                        short_number(active.optimum.objective), setting_text(loop_of(asked, active.optimum)));
  return text;
}

std::string others_text(const Asked& asked) {
  if (asked.answer.top.size() < 2) return "";
  std::string text = "\nnext best\n";
  for (std::size_t i = 1; i < asked.answer.top.size(); ++i) {
    const Found& found = asked.answer.top[i];
    text += fmt::format("  {:>3}  {:>12}  {}\n", i + 1, short_number(found.objective),
                        setting_text(loop_of(asked, found)));
  }
  return text;
}

void print_as_table(const Asked& asked) {
  const Found& best = asked.answer.top.front();
  const Loop loop = loop_of(asked, best);
  const auto& plant = asked.question.plant;
  std::string text = fmt::format("{} = {} at {}\n", asked.question.minimize.text(), short_number(best.objective),
                                 setting_text(loop));
  text += share_text(asked.answer) + active_text(asked);
  if (plant) {
    text += fmt::format("\ncontroller for {}\n", plant_text(*plant));
    text += controller_text(controller_for(loop, *plant), loop.family);
  }
  text +=
      "\n" + measures_table(best.measures, asked.grid.measures, plant ? "real units, unit steps" : "normalised");
  print_text(text + others_text(asked));
}

/// Why nothing is admissible, and what comes nearest.
std::string none_text(const Asked& asked) {
  const Answer& answer = asked.answer;
  std::string text = "no admissible setting: " + share_text(answer);
  for (std::size_t i = 0; i < asked.question.where.size(); ++i)
    text += fmt::format("  {} excludes {}{}\n", asked.question.where[i].text(), answer.excluded[i],
                        answer.strictest == i ? ", the most" : "");
  if (!answer.near_miss) return text;
  text += fmt::format("least violation at {}:\n", setting_text(loop_of(asked, answer.near_miss->found)));
  for (const Violation& v : answer.near_miss->violations)
    text += fmt::format("  {}: {} against {}\n", asked.question.where[v.constraint].text(), short_number(v.left),
                        short_number(v.right));
  return text;
}

int query(const QueryArguments& a) {
  if (a.json && a.csv) throw InputError("--json and --csv: give one of the two");
  const PortraitReader portrait(a.file);
  const Question question = question_from(a, portrait.grid());
  const Answer answer = ask(portrait, question);
  const Asked asked{portrait.grid(), question, answer};
  if (question.plant && !a.json)
    print_message("note: bounds on measures are taken in real units, those on " +
                  std::string("axes in normalised ones"));
  if (a.json) print_as_json(asked);
  if (a.csv) print_as_csv(asked);
  if (answer.top.empty()) {
    std::string text = none_text(asked);
    text.pop_back();
    print_message(text);
    return kNoneAdmissible;
  }
  if (!a.json && !a.csv) print_as_table(asked);
  return kDone;
}

}  // namespace

void add_query(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<QueryArguments>();
  CLI::App* verb = add_verb(app, "query", "the best settings of a portrait under constraints", kHelp);
  verb->add_option("file", a->file, "portrait file")->required();
  verb->add_option("--minimize", a->minimize, "what to minimize: an expression")->required();
  verb->add_option("--where", a->where, "a constraint, EXPR <= X (or <, >=, >, ==); any number of times")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  verb->add_option("--top", a->top, "how many of the best settings to list")->capture_default_str();
  verb->add_option("--plant", a->plant, "K=..,Td=..[,T1=..]: the answer in the units of this plant");
  verb->add_flag("--include-not-settled", a->include_not_settled,
                 "also settings whose responses had not settled at the horizon");
  verb->add_flag("--json", a->json, "one JSON object instead of tables");
  verb->add_flag("--csv", a->csv, "the best settings as CSV, a row each");
  verb->callback([a, &invocation] { invocation.exit_code = query(*a); });
}

}  // namespace portrait::tools
