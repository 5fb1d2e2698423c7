#include "tools/query_kinds.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/pareto.h"
#include "portraits/query/refine.h"
#include "portraits/query/region.h"
#include "portraits/query/trade_off.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/query_output.h"
#include "tools/query_rules.h"

namespace portrait::tools {
namespace {

/// Cut at the commas that stand in no parentheses: min(a, b), c.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

int none_admissible(const QueryRequest& request, std::uint64_t total) {
  if (request.form != OutputForm::csv)
    print_message(fmt::format("no admissible setting of {}: ask with --minimize to see what excludes them", total));
  return kNoneAdmissible;
}

// ---------------------------------------------------------------- the front

Found point_found(const QueryRequest& request, const FrontPoint& point) {
  return found_at(request.portrait, request.conditions.units, point.number, point.values[0]);
}

Json json_point(const QueryRequest& request, const ParetoQuestion& question, const FrontPoint& point) {
  Json json = json_found(request.grid(), request.conditions.units, point_found(request, point));
  json.erase("objective");
  for (std::size_t k = 0; k < question.minimize.size(); ++k)
    json["values"][question.minimize[k].text()] = json_number(point.values[k]);
  return json;
}

void print_front_json(const QueryRequest& request, const ParetoQuestion& question, const ParetoAnswer& answer) {
  Json subset = Json::array(), front = Json::array();
  for (const std::size_t i : answer.subset) subset.push_back(json_point(request, question, answer.front[i]));
  for (const FrontPoint& point : answer.front) {
    Json values = Json::array();
    for (std::size_t k = 0; k < question.minimize.size(); ++k) values.push_back(json_number(point.values[k]));
    front.push_back(values);
  }
  Json json{{"knee", json_point(request, question, answer.front[answer.knee])},
            {"subset", subset},
            {"front", front},
            {"admissible", answer.admissible},
            {"total", answer.total}};
  add_units(json, request.grid(), request.conditions);
  print_json(json);
}

std::string front_text(const QueryRequest& request, const ParetoQuestion& question, const ParetoAnswer& answer) {
  std::string text =
      fmt::format("{} of {} admissible settings are on the front of", answer.front.size(), answer.admissible);
  for (const Expression& expression : question.minimize) text += fmt::format(" {:>12}", expression.text());
  text += "\n";
  std::vector<std::size_t> shown = answer.subset;
  if (std::find(shown.begin(), shown.end(), answer.knee) == shown.end()) shown.push_back(answer.knee);
  std::sort(shown.begin(), shown.end());
  for (const std::size_t i : shown) {
    text += i == answer.knee ? "  knee" : "      ";
    for (std::size_t k = 0; k < question.minimize.size(); ++k)
      text += fmt::format("  {:>12}", short_number(answer.front[i].values[k]));
    text += "  " + setting_text(request.grid(), point_found(request, answer.front[i])) + "\n";
  }
  return text + units_text(request.grid(), request.conditions);
}

// ---------------------------------------------------------------- the region

std::string correlations_text(const Region& region) {
  std::string text;
  const std::size_t axes = region.axes.size();
  for (std::size_t j = 0; j < axes; ++j)
    for (std::size_t k = j + 1; k < axes; ++k) {
      const double r = region.correlation[j * axes + k];
      if (std::abs(r) >= 0.5)
        text += fmt::format("  {} and {} {} (correlation {:.2f})\n", to_string(region.axes[j].parameter),
                            to_string(region.axes[k].parameter),
                            r > 0 ? "rise together" : "go against each other", r);
    }
  return text;
}

constexpr std::size_t kPiecesShown = 5;

/// "  2 separate pieces\n    530 settings: kappa 0.1..0.2, ...": nothing when all hangs together.
std::string pieces_text(const Grid& grid, const std::vector<Piece>& pieces) {
  if (pieces.size() < 2) return "  one piece: every setting is reached by steps along the axes\n";
  std::string text = fmt::format("  {} separate pieces (steps along one axis at a time)\n", pieces.size());
  for (std::size_t i = 0; i < std::min(pieces.size(), kPiecesShown); ++i) {
    text += fmt::format("    {} setting{}:", pieces[i].settings, pieces[i].settings == 1 ? "" : "s");
    for (std::size_t k = 0; k < grid.axes.size(); ++k) {
      const Axis& axis = grid.axes[k];
      const std::string first = number_text(axis[pieces[i].first[k]]), last = number_text(axis[pieces[i].last[k]]);
      text += fmt::format("{} {} {}", k == 0 ? "" : ",", axis.name(), first == last ? first : first + ".." + last);
    }
    text += "\n";
  }
  if (pieces.size() > kPiecesShown) text += fmt::format("    and {} smaller ones\n", pieces.size() - kPiecesShown);
  return text;
}

Json json_pieces(const Grid& grid, const std::vector<Piece>& pieces) {
  Json list = Json::array();
  for (const Piece& piece : pieces) {
    Json axes = Json::object();
    for (std::size_t k = 0; k < grid.axes.size(); ++k)
      axes[std::string(grid.axes[k].name())] = {{"from", json_number(grid.axes[k][piece.first[k]])},
                                                {"to", json_number(grid.axes[k][piece.last[k]])}};
    list.push_back({{"settings", piece.settings}, {"axes", axes}});
  }
  return list;
}

std::string region_text(const Grid& grid, const Region& region) {
  std::string text = fmt::format("{} of {} settings are admissible ({:.3g} %)\n", region.admissible, region.total,
                                 100 * static_cast<double>(region.admissible) / static_cast<double>(region.total));
  for (std::size_t k = 0; k < region.axes.size(); ++k) {
    const AxisExtent& extent = region.axes[k];
    const Axis& axis = grid.axes[k];
    text += fmt::format("  {:<6} {} .. {}  ({} of {} values){}\n", axis.name(), number_text(axis[*extent.first]),
                        number_text(axis[*extent.last]), *extent.last - *extent.first + 1, axis.size(),
                        extent.at_lower_edge && extent.at_upper_edge ? ", cut off by both ends of the grid"
                        : extent.at_lower_edge                       ? ", cut off by the grid's lower end"
                        : extent.at_upper_edge                       ? ", cut off by the grid's upper end"
                                                                     : "");
  }
  return text + correlations_text(region) + pieces_text(grid, region.pieces);
}

Json json_region(const Grid& grid, const Region& region) {
  Json axes = Json::object();
  for (std::size_t k = 0; k < region.axes.size(); ++k) {
    const AxisExtent& extent = region.axes[k];
    axes[std::string(grid.axes[k].name())] = {{"from", json_number(grid.axes[k][*extent.first])},
                                              {"to", json_number(grid.axes[k][*extent.last])},
                                              {"counts", extent.counts},
                                              {"at_lower_edge", extent.at_lower_edge},
                                              {"at_upper_edge", extent.at_upper_edge}};
  }
  Json correlation = Json::array();
  for (const double value : region.correlation) correlation.push_back(json_number(value));
  return {{"admissible", region.admissible},
          {"total", region.total},
          {"axes", axes},
          {"correlation", correlation},
          {"pieces", json_pieces(grid, region.pieces)}};
}

// ---------------------------------------------------------------- one setting

Setting setting_from(const QueryRequest& request, const std::string& text) {
  Setting setting = setting_argument("--why", text, request.grid());
  if (const auto reason = why_invalid(Loop{request.grid().family, setting}))
    throw InputError(fmt::format("--why: {}", *reason));
  return setting;
}

std::string verdict_text(const QueryRequest& request, const Verdict& verdict) {
  std::string text =
      fmt::format("{} is {}\n", portrait::setting_text(Loop{request.grid().family, verdict.measured.setting}),
                  verdict.admissible() ? "admissible" : "not admissible");
  if (!verdict.right_status) text += fmt::format("  it is {}\n", to_string(verdict.measured.status));
  for (std::size_t j = 0; j < verdict.constraints.size(); ++j) {
    const Verdict::Side& side = verdict.constraints[j];
    text += fmt::format("  {}  {}: {} against {}{}\n", side.holds ? "holds" : "fails",
                        request.conditions.where[j].text(), short_number(side.left), short_number(side.right),
                        std::isnan(side.relative) ? "" : fmt::format(", {:.3g} % away", 100 * side.relative));
  }
  return text;
}

Json json_verdict(const QueryRequest& request, const Verdict& verdict) {
  Json constraints = Json::array();
  for (std::size_t j = 0; j < verdict.constraints.size(); ++j) {
    const Verdict::Side& side = verdict.constraints[j];
    constraints.push_back({{"constraint", request.conditions.where[j].text()},
                           {"holds", side.holds},
                           {"value", json_number(side.left)},
                           {"bound", json_number(side.right)},
                           {"relative", json_number(side.relative)}});
  }
  return {{"settings", json_settings({request.grid().family, verdict.measured.setting})},
          {"status", to_string(verdict.measured.status)},
          {"admissible", verdict.admissible()},
          {"constraints", constraints},
          {"measures", json_measures(verdict.measured.measures, request.grid().measures)}};
}

// ---------------------------------------------------------------- along a bound

struct Along {
  Expression expression;
  std::vector<double> bounds;
};

/// "Ms=1.3..2.0:15"
Along along_argument(const std::string& text) {
  const auto wrong = [&] {
    return InputError(
        fmt::format("--along: \"{}\" is not of the form EXPR=FROM..TO:COUNT, as Ms=1.3..2.0:15", text));
  };
  const std::size_t equals = text.rfind('='), dots = text.find("..", equals == std::string::npos ? 0 : equals);
  const std::size_t colon = text.find(':', dots == std::string::npos ? 0 : dots);
  if (equals == std::string::npos || dots == std::string::npos || colon == std::string::npos) throw wrong();
  const double from = number_argument("--along", text.substr(equals + 1, dots - equals - 1));
  const double to = number_argument("--along", text.substr(dots + 2, colon - dots - 2));
  const double count = number_argument("--along", text.substr(colon + 1));
  if (!(from < to) || !std::isfinite(from) || !std::isfinite(to) || !(count >= 2) || count > 10000 ||
      count != std::floor(count))
    throw wrong();
  Along along{parse_expression({"--along", text.substr(0, equals)}), {}};
  for (int i = 0; i < static_cast<int>(count); ++i) along.bounds.push_back(from + (to - from) * i / (count - 1));
  along.bounds.back() = to;
  return along;
}

struct AlongPoint {
  double bound;
  Setting setting;
  double objective, reached;  ///< of the expression
};

std::vector<AlongPoint> points_along(const QueryRequest& request, const Question& question, const Along& along,
                                     bool refined) {
  std::vector<AlongPoint> points;
  for (const TradeOffPoint& point : trade_off(request.portrait, question, along.expression, along.bounds)) {
    if (!point.best) continue;
    Measured at{point.best->setting, point.best->status, point.best->measures, request.conditions.units.plant};
    double objective = point.best->objective;
    if (refined) {
      Conditions conditions = request.conditions;
      conditions.where.push_back(bound_constraint(along.expression, point.bound));
      const Refined better = refine(request.grid(), question.minimize, conditions, point.best->setting);
      at = better.best;
      objective = better.objective;
    }
    points.push_back({point.bound, at.setting, objective, value_at(along.expression, at)});
  }
  return points;
}

/// What a controller costs more than the best under its own bound.
struct Regret {
  double reached, objective, best;
  double part() const { return objective / best - 1; }
};

/// Of each of these, in their order: one pass over the portrait finds the best for all.
std::vector<Regret> regrets_of(const QueryRequest& request, const Question& question, const Along& along, bool refined,
                               std::span<const Measured> controllers) {
  std::vector<Regret> regrets;
  Along reached{along.expression, {}};
  for (const Measured& measured : controllers) {
    regrets.push_back({value_at(along.expression, measured), value_at(question.minimize, measured), kNaN});
    reached.bounds.push_back(regrets.back().reached);
  }
  std::sort(reached.bounds.begin(), reached.bounds.end());
  for (const AlongPoint& point : points_along(request, question, reached, refined))
    for (Regret& regret : regrets)
      if (regret.reached == point.bound) regret.best = point.objective;
  return regrets;
}

Json json_regret(const Regret& regret) {
  return {{"reached", json_number(regret.reached)},
          {"objective", json_number(regret.objective)},
          {"best", json_number(regret.best)},
          {"regret", json_number(regret.part())}};
}

void add_regret(const QueryRequest& request, const Question& question, const Along& along, const AlongRequest& asked,
                Json& json, std::string& table) {
  const Verdict verdict = judge(request.grid(), request.conditions, setting_from(request, asked.setting));
  const Regret regret = regrets_of(request, question, along, asked.refine, {&verdict.measured, 1}).front();
  json["regret"] = json_regret(regret);
  table += fmt::format("{}: {} at {} = {}; the best there is {}: regret {:.3g} %\n", asked.setting,
                       short_number(regret.objective), along.expression.text(), short_number(regret.reached),
                       short_number(regret.best), 100 * regret.part());
}

/// Of rules that have a stable loop here.
void add_rules(const QueryRequest& request, const Question& question, const Along& along, const AlongRequest& asked,
               Json& json, std::string& table) {
  std::vector<RuleOnPortrait> rules = rules_on(request.grid(), question, std::nullopt);
  std::erase_if(rules, [](const RuleOnPortrait& r) { return !r.not_applicable.empty() || std::isnan(r.objective); });
  std::vector<Measured> measured;
  for (const RuleOnPortrait& r : rules)
    measured.push_back({r.setting, r.status, r.measures, request.conditions.units.plant});
  const std::vector<Regret> regrets = regrets_of(request, question, along, asked.refine, measured);
  table += fmt::format("\nrules, with the portrait's filter and prefilter\n  {:<20} {:>12}  {:>12}  {:>12}  {:>10}\n", "",
                       along.expression.text(), asked.minimize.size() > 12 ? "objective" : asked.minimize, "best there",
                       "regret");
  Json list = Json::array();
  for (std::size_t k = 0; k < rules.size(); ++k) {
    const RuleOnPortrait& r = rules[k];
    const Regret& regret = regrets[k];
    Json of_rule = json_regret(regret);
    of_rule["rule"] = r.rule->name;
    of_rule["remark"] = rule_remark(question, r);
    of_rule["settings"] = json_settings({request.grid().family, r.setting});
    list.push_back(std::move(of_rule));
    const bool compared = !std::isnan(regret.best);
    table += fmt::format("  {:<20} {:>12}  {:>12}  {:>12}  {:>10}  {}\n", r.rule->name, short_number(regret.reached),
                         short_number(regret.objective), compared ? short_number(regret.best) : "none",
                         compared ? fmt::format("{:.3g} %", 100 * regret.part()) : "", rule_remark(question, r));
  }
  json["rules"] = std::move(list);
}

}  // namespace

int print_pareto(const QueryRequest& request, const std::string& expressions, std::size_t points) {
  ParetoQuestion question{{}, request.conditions, points};
  for (const std::string& part : parts_of(expressions))
    question.minimize.push_back(parse_expression({"--pareto", part}));
  const ParetoAnswer answer = pareto(request.portrait, question);
  if (answer.front.empty()) return none_admissible(request, answer.total);
  if (request.form == OutputForm::json) print_front_json(request, question, answer);
  if (request.form == OutputForm::text) print_text(front_text(request, question, answer));
  if (request.form != OutputForm::csv) return kDone;
  std::vector<Found> rows;
  for (const FrontPoint& point : answer.front) rows.push_back(point_found(request, point));
  print_text(csv_text(request.grid(), rows));
  return kDone;
}

int print_region(const QueryRequest& request) {
  const Region found = region(request.portrait, request.conditions);
  if (found.admissible == 0) return none_admissible(request, found.total);
  if (request.form == OutputForm::json)
    print_json(json_region(request.grid(), found));
  else
    print_text(region_text(request.grid(), found) + units_text(request.grid(), request.conditions));
  return kDone;
}

int print_why(const QueryRequest& request, const std::string& text, const std::string& minimize) {
  const Setting setting = setting_from(request, text);
  const Verdict verdict = judge(request.grid(), request.conditions, setting);
  const auto nearest = nearest_admissible(request.portrait, request.conditions, setting);
  std::string said = verdict_text(request, verdict);
  Json json = json_verdict(request, verdict);
  json["nearest"] = nearest ? json_found(request.grid(), request.conditions.units, nearest->found) : Json(nullptr);
  if (nearest && !verdict.admissible())
    said += fmt::format("nearest admissible: {}\n", setting_text(request.grid(), nearest->found));
  if (!nearest) said += "no setting of the grid is admissible\n";
  if (!minimize.empty()) {
    const Expression objective = parse_expression({"--minimize", minimize});
    require_available(objective, request.grid(), request.conditions.units.plant.has_value());
    const double here = value_at(objective, verdict.measured);
    json["objective"] = json_number(here);
    said += fmt::format("{} = {}\n", minimize, short_number(here));
  }
  if (request.form == OutputForm::json)
    print_json(json);
  else
    print_text(said + units_text(request.grid(), request.conditions));
  return kDone;
}

int print_along(const QueryRequest& request, const AlongRequest& asked) {
  const Along along = along_argument(asked.along);
  const Question question{.minimize = parse_expression({"--minimize", asked.minimize}), .conditions = request.conditions};
  const std::vector<AlongPoint> points = points_along(request, question, along, asked.refine);
  if (points.empty()) return none_admissible(request, setting_count(request.grid()));
  Json list = Json::array();
  std::string table = fmt::format("{:>12}  {:>12}  {:>12}\n", along.expression.text() + " <=", asked.minimize, "reached");
  for (const AlongPoint& point : points) {
    list.push_back({{"bound", point.bound},
                    {"objective", json_number(point.objective)},
                    {"reached", json_number(point.reached)},
                    {"settings", json_settings({request.grid().family, point.setting})}});
    table += fmt::format("{:>12}  {:>12}  {:>12}  {}\n", short_number(point.bound), short_number(point.objective),
                         short_number(point.reached),
                         portrait::setting_text(Loop{request.grid().family, point.setting}));
  }
  Json json{{"along", along.expression.text()}, {"points", list}};
  add_units(json, request.grid(), request.conditions);
  if (!asked.setting.empty()) add_regret(request, question, along, asked, json, table);
  if (asked.rules) add_rules(request, question, along, asked, json, table);
  if (request.form == OutputForm::json)
    print_json(json);
  else
    print_text(table);
  return kDone;
}

}  // namespace portrait::tools
