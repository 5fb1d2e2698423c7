/// portrait query: what a portrait answers, in normalised or real units.

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/query.h"
#include "portraits/query/refine.h"
#include "portraits/reader.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/query_kinds.h"
#include "tools/query_output.h"
#include "tools/query_robust.h"
#include "tools/query_rules.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait query huba.h5 --minimize 'IAE_w + IAE_d' --where 'TV2_ud <= 0.1' --where 'delta == 0.35'
  portrait query huba.h5 --minimize IAE_d --where 'Ms <= 2' --where 'Kc <= 3' --plant K=2,Td=0.5 --top 5

Finds the setting of a portrait with the smallest value of an expression among those that
meet every constraint. Expressions are over the portrait's measures (IAE_w, TV2_ud, Ms, ...)
and its axes (kappa, tau_i, ...) with + - * / ^, parentheses, abs, min, max, sqrt, log, exp.
With --plant all measures, and so the bounds on them, are in real units, for steps of the
sizes that --step gives, and the values of the real controller, Kc Ti TD Ki Kd Tf, can be
named as well; names of axes keep meaning normalised values.

More answers:
  portrait query huba.h5 --minimize IAE_d --where 'Ms <= 2' --refine
  portrait query huba.h5 --pareto IAE_w,IAE_d,TV_uw --where 'Ms <= 2'
  portrait query huba.h5 --minimize IAE_d --along Ms=1.4..2.2:9 --refine
  portrait query huba.h5 --why kappa=0.3,tau_i=8,delta=0.7 --where 'TV2_ud <= 0.1'
  portrait query huba.h5 --region --where 'Ms <= 2'

A plant known only within bounds: one controller under which every plant of the box meets
every constraint, guaranteed between the simulated plants too. Settings are controllers for
the nominal plant, --plant or the middle of the box; names of axes mean those settings.
  portrait query huba.h5 --minimize IAE_d --where 'Ms <= 2' --uncertain K=0.8..1.2,Td=0.8..1.2)";

struct QueryArguments {
  std::string file, minimize, plant, step, pareto, why, along, uncertain, over = "worst";
  std::vector<std::string> where;
  std::size_t top = 1, points = 12;
  int threads = 0;
  double coarse = 100 * kCoarseFrom;
  bool refine = false, region = false;
  bool include_not_settled = false, rules = false, json = false, csv = false;
};

/// Everything that the printing below needs to know.
struct Asked {
  const Grid& grid;
  const Question& question;
  const Answer& answer;
  std::optional<Refined> refined;
  double coarse = kCoarseFrom;

  const QueryUnits& units() const { return question.conditions.units; }
  const std::string& constraint(std::size_t j) const { return question.conditions.where[j].text(); }
  std::size_t constraints() const { return question.conditions.where.size(); }
};

Conditions conditions_from(const QueryArguments& a, const Grid& grid) {
  Conditions conditions;
  for (const std::string& text : a.where) conditions.where.push_back(parse_constraint({"--where", text}));
  if (!a.plant.empty()) conditions.units.plant = real_plant_argument("--plant", a.plant, grid.family.plant);
  if (!a.step.empty()) conditions.units.steps = step_argument("--step", a.step);
  conditions.include_not_settled = a.include_not_settled;
  conditions.threads = a.threads;
  return conditions;
}

Found found_of(const Refined& refined) {
  return {0, refined.best.setting, refined.best.measures, refined.objective, refined.best.status};
}

// ---------------------------------------------------------------- JSON

Json json_active(const Asked& asked) {
  Json list = Json::array();
  for (const ActiveConstraint& active : asked.answer.active) {
    Json one{{"constraint", asked.constraint(active.constraint)},
             {"objective_without", json_number(active.optimum.objective)},
             {"settings_without", json_settings({asked.grid.family, active.optimum.setting})}};
    if (const auto& loosened = active.loosened)
      one["loosened"] = {{"by", json_number(loosened->relative)},
                         {"value", json_number(loosened->left)},
                         {"bound", json_number(loosened->right)},
                         {"objective", json_number(loosened->found.objective)},
                         {"settings", json_settings({asked.grid.family, loosened->found.setting})}};
    list.push_back(one);
  }
  return list;
}

Json json_excluded(const Asked& asked) {
  Json list = Json::array();
  for (std::size_t j = 0; j < asked.answer.excluded.size(); ++j)
    list.push_back({{"constraint", asked.constraint(j)}, {"excluded", asked.answer.excluded[j]}});
  return list;
}

Json json_near_miss(const Asked& asked) {
  const auto& miss = asked.answer.near_miss;
  if (!miss) return nullptr;
  Json violations = Json::array();
  for (const Violation& v : miss->violations)
    violations.push_back({{"constraint", asked.constraint(v.constraint)},
                          {"value", json_number(v.left)},
                          {"bound", json_number(v.right)}});
  return {{"settings", json_settings({asked.grid.family, miss->found.setting})}, {"violations", violations}};
}

Json json_names(const std::vector<Parameter>& parameters) {
  Json names = Json::array();
  for (const Parameter parameter : parameters) names.push_back(to_string(parameter));
  return names;
}

Json json_refined(const Asked& asked) {
  const Refined& refined = *asked.refined;
  Json json = json_found(asked.grid, asked.units(), found_of(refined));
  Json prices = Json::array();
  for (std::size_t j = 0; j < refined.prices.size(); ++j)
    prices.push_back({{"constraint", asked.constraint(j)},
                      {"price", json_number(refined.prices[j])},
                      {"value", json_number(refined.left[j])}});
  json["gain"] = json_number(refined.gain());
  json["prices"] = prices;
  json["at_edge"] = json_names(refined.at_edge);
  json["converged"] = refined.converged;
  json["settings_measured"] = refined.settings_measured;
  json["grid_too_coarse"] = refined.gain() > asked.coarse;
  return json;
}

void print_as_json(const Asked& asked, const std::optional<std::vector<RuleOnPortrait>>& rules) {
  const Answer& answer = asked.answer;
  Json top = Json::array();
  for (const Found& found : answer.top) top.push_back(json_found(asked.grid, asked.units(), found));
  Json json{{"optimum", answer.top.empty() ? Json(nullptr) : top.front()},
            {"active", json_active(asked)},
            {"top", top},
            {"admissible", answer.admissible},
            {"total", answer.total},
            {"left_out", json_left_out(answer.left_out)}};
  if (asked.refined) json["refined"] = json_refined(asked);
  if (!answer.top.empty()) json["at_edge"] = json_names(edges_at(asked.grid, answer.top[0].setting));
  add_units(json, asked.grid, asked.question.conditions);
  if (answer.top.empty()) {
    json["excluded"] = json_excluded(asked);
    json["least_violation"] = json_near_miss(asked);
  }
  if (rules) json["rules"] = json_rules(asked.grid, asked.question, *rules);
  print_json(json);
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

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

/// What the constraint costs: "; at 0.104 (4.2 % looser) already 35.1 (5.0 % better)".
std::string price_text(const ActiveConstraint& active, double optimum) {
  const auto& loosened = active.loosened;
  if (!loosened || !(loosened->relative < kInf)) return "";
  const double gain = (optimum - loosened->found.objective) / std::abs(optimum);
  return fmt::format("; at {} ({} looser) already {} ({} better)", short_number(loosened->left),
                     percent(loosened->relative), short_number(loosened->found.objective), percent(gain));
}

std::string active_text(const Asked& asked) {
  if (asked.constraints() == 0) return "";
  if (asked.answer.active.empty())
    return "no constraint is active: the optimum is the same without any one of them\n";
  std::string text;
  for (const ActiveConstraint& active : asked.answer.active)
    text += fmt::format("active: {}; without it {} at {}{}\n", asked.constraint(active.constraint),
                        short_number(active.optimum.objective), setting_text(asked.grid, active.optimum),
                        price_text(active, asked.answer.top.front().objective));
  return text;
}

std::string others_text(const Asked& asked) {
  if (asked.answer.top.size() < 2) return "";
  std::string text = "\nnext best\n";
  for (std::size_t i = 1; i < asked.answer.top.size(); ++i) {
    const Found& found = asked.answer.top[i];
    text +=
        fmt::format("  {:>3}  {:>12}  {}\n", i + 1, short_number(found.objective), setting_text(asked.grid, found));
  }
  return text;
}

std::string names_text(const std::vector<Parameter>& parameters) {
  std::vector<std::string_view> names;
  for (const Parameter parameter : parameters) names.push_back(to_string(parameter));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string refined_text(const Asked& asked) {
  if (!asked.refined) return "";
  const Refined& refined = *asked.refined;
  std::string text =
      fmt::format("\nrefined: {} = {:.10g} at {}\n  {} better than the grid ({} settings measured{})\n",
                  asked.question.minimize.text(), refined.objective, setting_text(asked.grid, found_of(refined)),
                  percent(refined.gain()), refined.settings_measured, refined.converged ? "" : ", not converged");
  for (std::size_t j = 0; j < refined.prices.size(); ++j)
    if (refined.prices[j] > 0)
      text +=
          fmt::format("  active: {}; 1 % looser gives {} better\n", asked.constraint(j),
                      percent(refined.prices[j] * 0.01 * std::abs(refined.right[j]) / std::abs(refined.objective)));
  return text + found_text(asked.grid, asked.units(), found_of(refined));
}

/// What the user should know of the grid, to stderr.
void warn(const Asked& asked) {
  const auto edges = edges_at(asked.grid, asked.answer.top[0].setting);
  if (!edges.empty())
    print_message(fmt::format("note: the optimum lies on the edge of the grid ({}); better may lie beyond",
                              names_text(edges)));
  if (!asked.refined) return;
  if (!asked.refined->at_edge.empty())
    print_message(fmt::format("note: the refined optimum lies on the edge of the grid ({})",
                              names_text(asked.refined->at_edge)));
  if (asked.refined->gain() > asked.coarse)
    print_message(fmt::format("note: the grid is too coarse here: between its points the optimum is {} better",
                              percent(asked.refined->gain())));
}

void print_as_table(const Asked& asked) {
  const Found& best = asked.answer.top.front();
  std::string text = fmt::format("{} = {} at {}\n", asked.question.minimize.text(), short_number(best.objective),
                                 setting_text(asked.grid, best));
  text += share_text(asked.answer) + active_text(asked);
  if (asked.constraints() > 0) text += "\nconstraints\n" + units_text(asked.grid, asked.question.conditions);
  print_text(text + found_text(asked.grid, asked.units(), best) + others_text(asked) + refined_text(asked));
}

/// Why nothing is admissible, and what comes nearest.
std::string none_text(const Asked& asked) {
  const Answer& answer = asked.answer;
  std::string text = "no admissible setting: " + share_text(answer);
  for (std::size_t j = 0; j < answer.excluded.size(); ++j)
    text += fmt::format("  {} excludes {}{}\n", asked.constraint(j), answer.excluded[j],
                        answer.strictest == j ? ", the most" : "");
  if (!answer.near_miss) return text;
  text += fmt::format("least violation at {}:\n", setting_text(asked.grid, answer.near_miss->found));
  for (const Violation& v : answer.near_miss->violations)
    text += fmt::format("  {}: {} against {}\n", asked.constraint(v.constraint), short_number(v.left),
                        short_number(v.right));
  return text;
}

std::optional<double> optimum_of(const Answer& answer) {
  return answer.top.empty() ? std::nullopt : std::optional(answer.top.front().objective);
}

int best(const QueryArguments& a, const QueryRequest& request);

/// What --uncertain does not go together with is said, not left out.
int robust(const QueryArguments& a, const QueryRequest& request) {
  const std::pair<bool, const char*> others[] = {{!a.pareto.empty(), "--pareto"}, {!a.along.empty(), "--along"},
                                                 {a.region, "--region"},          {a.refine, "--refine"},
                                                 {a.rules, "--rules"}};
  for (const auto& [given, name] : others)
    if (given) throw InputError(fmt::format("--uncertain and {}: give one of the two", name));
  if (a.minimize.empty()) throw InputError("--minimize is missing: an expression, as IAE_w + IAE_d");
  return print_robust(request, {a.minimize, a.uncertain, a.over, a.why, a.top});
}

int query(const QueryArguments& a) {
  if (a.json && a.csv) throw InputError("--json and --csv: give one of the two");
  const PortraitReader portrait(a.file);
  const QueryRequest request{portrait, conditions_from(a, portrait.grid()),
                             a.json  ? OutputForm::json
                             : a.csv ? OutputForm::csv
                                     : OutputForm::text};
  if (!a.uncertain.empty()) return robust(a, request);
  if (a.over != "worst") throw InputError("--objective-over belongs to --uncertain");
  if (!a.pareto.empty()) return print_pareto(request, a.pareto, a.points);
  if (a.region) return print_region(request);
  if (!a.why.empty() && a.along.empty()) return print_why(request, a.why, a.minimize);
  if (a.minimize.empty()) throw InputError("--minimize is missing: an expression, as IAE_w + IAE_d");
  if (!a.along.empty()) return print_along(request, a.minimize, a.along, a.refine, a.why);
  return best(a, request);
}

int best(const QueryArguments& a, const QueryRequest& request) {
  const Question question{
      .minimize = parse_expression({"--minimize", a.minimize}), .conditions = request.conditions, .top = a.top};
  const Answer answer = ask(request.portrait, question);
  Asked asked{request.grid(), question, answer, std::nullopt, a.coarse / 100};
  if (a.refine && !answer.top.empty())
    asked.refined = refine(request.grid(), question.minimize, question.conditions, answer.top[0].setting);
  if (!answer.top.empty() && request.form == OutputForm::text) warn(asked);
  const auto rules = a.rules ? std::optional(rules_on(request.grid(), question, optimum_of(answer))) : std::nullopt;
  if (a.json) print_as_json(asked, rules);
  if (a.csv) print_text(csv_text(request.grid(), answer.top));
  if (answer.top.empty()) {
    std::string text = none_text(asked);
    text.pop_back();
    print_message(text);
    return kNoneAdmissible;
  }
  if (!a.json && !a.csv) print_as_table(asked);
  if (rules && !a.json && !a.csv) print_text(rules_text(request.grid(), question, *rules));
  return kDone;
}

}  // namespace

void add_query(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<QueryArguments>();
  CLI::App* verb = add_verb(app, "query", "the best settings of a portrait under constraints", kHelp);
  verb->add_option("file", a->file, "portrait file")->required();
  verb->add_option("--minimize", a->minimize, "what to minimize: an expression");
  verb->add_option("--pareto", a->pareto, "EXPR,EXPR[,EXPR]: the settings that no other beats in all of these");
  verb->add_option("--points", a->points, "how many of the front to list, evenly spread")->capture_default_str();
  verb->add_flag("--region", a->region, "the admissible region: its size, place and shape");
  verb->add_option("--why", a->why, "kappa=..,tau_i=..: which constraints this setting fails, by how much");
  verb->add_option("--along", a->along, "EXPR=FROM..TO:COUNT: the best objective for each EXPR <= bound");
  verb->add_flag("--refine", a->refine, "the optimum between the grid's points, with the engine");
  verb->add_option("--coarse", a->coarse, "gain by --refine, in %, above which the grid is called too coarse")
      ->capture_default_str();
  add_many(*verb, "--where", a->where, "a constraint, EXPR <= X (or <, >=, >, ==); any number of times");
  verb->add_option("--top", a->top, "how many of the best settings to list")->capture_default_str();
  verb->add_option("--plant", a->plant, "K=..,Td=..[,T1=..]: the answer in the units of this plant");
  verb->add_option("--uncertain", a->uncertain, "K=lo..hi,Td=lo..hi[,T1=lo..hi; jotd: Tj]: serve every plant of this box");
  verb->add_option("--objective-over", a->over, "with --uncertain, the objective over the box: worst, mean or nominal")
      ->capture_default_str();
  verb->add_option("--step", a->step, "w=..,d=..: sizes of the steps in setpoint and disturbance (1 each)");
  verb->add_flag("--rules", a->rules, "where each tuning rule lies: admissible or not, and its objective over the optimum's");
  verb->add_flag("--include-not-settled", a->include_not_settled,
                 "also settings whose responses had not settled at the horizon");
  verb->add_option("--threads", a->threads, "threads to read with (all)");
  verb->add_flag("--json", a->json, "one JSON object instead of tables");
  verb->add_flag("--csv", a->csv, "the best settings as CSV, a row each");
  verb->callback([a, &invocation] { invocation.exit_code = query(*a); });
}

}  // namespace portrait::tools
