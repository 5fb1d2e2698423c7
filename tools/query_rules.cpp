#include "tools/query_rules.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/rules/catalogue.h"
#include "engine/sweep/method.h"
#include "grids/sweep_job.h"

namespace portrait::tools {
namespace {

std::optional<double> fixed_value(const Grid& grid, Parameter parameter) {
  for (const FixedParameter& f : grid.fixed)
    if (f.parameter == parameter) return f.value;
  return std::nullopt;
}

/// The plant in whose units the rules work.
RealPlant plant_of(const Grid& grid, const QueryUnits& units) {
  if (has_gains(grid.family))
    throw InputError("--rules: of portraits with a PID controller; for gains see portrait tune");
  if (units.plant) return *units.plant;
  RealPlant plant{.family = grid.family.plant, .K = 1, .Td = 1, .T1 = 0};
  const std::optional<Parameter> parameter = lag_parameter(grid.family.plant);
  if (!parameter) return plant;
  const auto lag = fixed_value(grid, *parameter);
  if (!lag)
    throw InputError(fmt::format("--rules: {} is an axis of this portrait: give the plant, --plant K=..,Td=..,{}=..",
                                 to_string(*parameter), lag_name(grid.family.plant)));
  plant.T1 = *lag;
  return plant;
}

rules::RulePlant rule_plant(const RealPlant& p, int order) {
  switch (p.family) {
    case Plant::dipdt:
      return rules::dipdt(p.K, p.Td);
    case Plant::ipdt:
      return rules::ipdt(p.K, p.Td);
    default:
      break;
  }
  return rules::jotd(p.K, p.Td, p.T1, p.family == Plant::jotd ? order : 1);
}

/// The portrait's filter, where it has one value and the rule can take it into account.
std::map<std::string, std::string> options_for(const rules::Rule& rule, const Grid& grid, const RealPlant& plant) {
  const auto tau_f = fixed_value(grid, Parameter::tau_f);
  const auto takes = [&](std::string_view name) {
    return std::any_of(rule.options.begin(), rule.options.end(),
                       [&](const rules::OptionInfo& o) { return o.name == name; });
  };
  std::map<std::string, std::string> options;
  if (!tau_f || !takes("Tf")) return options;
  options["Tf"] = number_text(*tau_f * plant.Td);
  if (takes("n")) options["n"] = number_text(grid.family.n);
  return options;
}

/// kappa, tau_i and delta of the rule; filter and prefilter of the portrait where they are fixed, else the rule's own.
Setting setting_of(const rules::Tuned& tuned, const Grid& grid, const RealPlant& plant) {
  const RealController controller{.standard = *tuned.pid, .Tf = tuned.Tf, .b = tuned.b, .c = tuned.c};
  Setting setting = normalised(controller, plant, grid.family);
  if (tuned.prefilter != grid.family.prefilter) setting.b = setting.c = 0;
  for (const Parameter p : {Parameter::tau_f, Parameter::b, Parameter::c})
    if (const auto value = fixed_value(grid, p)) set(setting, p, *value);
  return setting;
}

Columns columns_of(const Grid& grid, const QueryUnits& units, const Setting& setting, const MeasureRow& measures) {
  Columns columns;
  columns.count = 1;
  for (const Measure m : all_measures()) columns[m] = {measures[m]};
  for (const Parameter p : parameters_of(grid.family)) columns[p] = {get(setting, p)};
  if (!units.plant) return columns;
  const auto of = [&](Parameter p) { return get(setting, p); };
  for (std::size_t i = 0; i < kControllerValueNames.size(); ++i) {
    const auto value = static_cast<ControllerValue>(i);
    columns[value] = {controller_value<double>(value, *units.plant, of)};
  }
  return columns;
}

double value_of(const Expression& expression, const Columns& columns) {
  ColumnStack stack;
  std::vector<double> values;
  expression.evaluate(columns, stack, values);
  return values[0];
}

/// Parameters of the setting that lie beyond the ends of their axes.
std::vector<std::string> off_axes(const Grid& grid, const Setting& setting) {
  std::vector<std::string> names;
  for (const Axis& axis : grid.axes) {
    const double value = get(setting, axis.parameter()), slack = std::isfinite(value) ? 1e-9 * std::abs(value) : 0;
    if (value < axis[0] - slack || value > axis[axis.size() - 1] + slack)
      names.emplace_back(to_string(axis.parameter()));
  }
  return names;
}

void measure_rule(const Grid& grid, const Question& question, std::optional<double> optimum, RuleOnPortrait& r) {
  SettingMeasured found;
  measure_settings(method_for(grid.measures), grid.family, grid.horizon, extras_for(grid), {&r.setting, 1},
                   {&found, 1});
  const Conditions& conditions = question.conditions;
  for (const Measure m : all_measures()) r.measures[m] = found.measures[m] * factor(m, conditions.units);
  r.status = found.status;
  const Columns columns = columns_of(grid, conditions.units, r.setting, r.measures);
  r.objective = value_of(question.minimize, columns);
  for (std::size_t j = 0; j < conditions.where.size(); ++j) {
    const Constraint& c = conditions.where[j];
    if (!holds(c.relation, value_of(c.left, columns), value_of(c.right, columns))) r.violated.push_back(j);
  }
  const bool eligible =
      r.status == Status::settled || (r.status == Status::not_settled && conditions.include_not_settled);
  r.admissible = eligible && r.violated.empty() && !std::isnan(r.objective);
  if (optimum) r.regret = r.objective / *optimum;
}

RuleOnPortrait rule_on(const rules::Rule& rule, const Grid& grid, const Question& question,
                       std::optional<double> optimum) {
  RuleOnPortrait r{&rule, "", {}, {}, kNaN, Status::not_computed, {}, {}};
  const RealPlant plant = plant_of(grid, question.conditions.units);
  try {
    const rules::Tuned tuned = rules::tune(rule, rule_plant(plant, grid.family.j), options_for(rule, grid, plant));
    if (!tuned.pid) {
      r.not_applicable = "its controller is no PID with one filter";
      return r;
    }
    r.setting = setting_of(tuned, grid, plant);
  } catch (const InputError& error) {
    r.not_applicable = error.what();
    return r;
  }
  if (const auto reason = why_invalid(Loop{grid.family, r.setting})) {
    r.not_applicable = *reason;
    return r;
  }
  r.off_axes = off_axes(grid, r.setting);
  measure_rule(grid, question, optimum, r);
  return r;
}

}  // namespace

bool has_what_is_fixed(const Grid& grid, const Setting& setting) {
  return std::all_of(grid.fixed.begin(), grid.fixed.end(), [&](const FixedParameter& f) {
    const double value = get(setting, f.parameter);
    return value == f.value || std::abs(value - f.value) <= 1e-9 * std::abs(f.value);
  });
}

std::string rule_remark(const Question& question, const RuleOnPortrait& r) {
  if (r.admissible) return "admissible";
  if (r.status == Status::settled && r.violated.empty()) return "without value";
  if (r.status != Status::settled && r.violated.empty()) return std::string(to_string(r.status));
  if (r.status == Status::unstable || r.violated.empty()) return std::string(to_string(r.status));
  return "violates " + question.conditions.where[r.violated[0]].text() +
         (r.violated.size() > 1 ? fmt::format(" and {} more", r.violated.size() - 1) : "");
}

std::vector<RuleOnPortrait> rules_on(const Grid& grid, const Question& question, std::optional<double> optimum) {
  std::vector<RuleOnPortrait> all;
  for (const rules::Rule& rule : rules::catalogue()) all.push_back(rule_on(rule, grid, question, optimum));
  std::stable_sort(all.begin(), all.end(), [](const RuleOnPortrait& a, const RuleOnPortrait& b) {
    const auto rank = [](const RuleOnPortrait& r) {
      return !r.not_applicable.empty() ? 3 : std::isnan(r.objective) ? 2 : r.admissible ? 0 : 1;
    };
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    return rank(a) < 2 && a.objective < b.objective;
  });
  return all;
}

Json json_rules(const Grid& grid, const Question& question, const std::vector<RuleOnPortrait>& rules) {
  Json list = Json::array();
  for (const RuleOnPortrait& r : rules) {
    if (!r.not_applicable.empty()) {
      list.push_back({{"rule", r.rule->name}, {"applicable", false}, {"why", r.not_applicable}});
      continue;
    }
    Json violated = Json::array();
    for (const std::size_t j : r.violated) violated.push_back(question.conditions.where[j].text());
    list.push_back({{"rule", r.rule->name},
                    {"applicable", true},
                    {"settings", json_settings({grid.family, r.setting})},
                    {"off_axes", r.off_axes},
                    {"status", to_string(r.status)},
                    {"objective", json_number(r.objective)},
                    {"admissible", r.admissible},
                    {"violated", violated},
                    {"regret", json_number(r.regret)},
                    {"measures", json_measures(r.measures, grid.measures)}});
  }
  return list;
}

std::string rules_text(const Grid& grid, const Question& question, const std::vector<RuleOnPortrait>& rules) {
  std::string text =
      fmt::format("\nrules, with the portrait's filter and prefilter\n  {:<20} {:>12} {:>8}  {}\n", "",
                  question.minimize.text().size() > 12 ? "objective" : question.minimize.text(), "regret", "");
  std::size_t not_applicable = 0;
  for (const RuleOnPortrait& r : rules) {
    if (!r.not_applicable.empty()) {
      ++not_applicable;
      continue;
    }
    text += fmt::format("  {:<20} {:>12} {:>8}  {}; {}{}\n", r.rule->name, short_number(r.objective),
                        std::isnan(r.regret) ? "" : fmt::format("{:.3f}", r.regret), rule_remark(question, r),
                        setting_text(Loop{grid.family, r.setting}),
                        r.off_axes.empty() ? "" : fmt::format("; off the axes {}", fmt::join(r.off_axes, ", ")));
  }
  return text + fmt::format("  {} rules do not apply to this portrait (--json says why)\n", not_applicable);
}

}  // namespace portrait::tools
