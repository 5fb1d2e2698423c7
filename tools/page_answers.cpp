#include "tools/page_answers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/loop/stability.h"
#include "engine/sweep/method.h"
#include "portraits/query/cloud.h"
#include "portraits/query/cross_section.h"
#include "tools/pictures/front.h"
#include "tools/pictures/loops.h"
#include "tools/pictures/text.h"
#include "tools/query_output.h"
#include "tools/query_rules.h"

namespace portrait::tools {
namespace {

constexpr std::size_t kCurvePoints = 600, kNyquistPoints = 400, kMostConstraints = 64;
/// A loop that has not settled in this time is cut there: a click has to answer at once.
constexpr double kLongestShown = 200;

// ---------------------------------------------------------------- reading requests

[[noreturn]] void unfit(const std::string& what) { throw InputError("request: " + what); }

std::string text_in(const Json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end() || found->is_null()) return "";
  if (!found->is_string()) unfit(fmt::format("{} is not a text", key));
  return *found;
}

bool flag_in(const Json& request, const char* key) {
  const auto found = request.find(key);
  return found != request.end() && found->is_boolean() && found->get<bool>();
}

std::uint64_t whole(const Json& value, const char* what, std::uint64_t below) {
  if (!value.is_number_integer() || value < 0 || value >= below)
    unfit(fmt::format("{} is not a whole number from 0 to {}", what, below - 1));
  return value;
}

std::uint64_t number_in(const Json& request, const Grid& grid) {
  const auto found = request.find("number");
  if (found == request.end()) unfit("number is missing");
  return whole(*found, "number", setting_count(grid));
}

double real_in(const Json& object, const char* key, double otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return otherwise;
  if (!found->is_number()) unfit(fmt::format("plant: {} is not a number", key));
  return *found;
}

QueryUnits units_in(const Json& request, const Grid& grid) {
  QueryUnits units;
  const auto found = request.find("plant");
  if (found != request.end() && !found->is_null()) {
    if (!found->is_object()) unfit("plant is not an object");
    units.plant =
        RealPlant{grid.family.plant, real_in(*found, "K", 1), real_in(*found, "Td", 0), real_in(*found, "T1", 0)};
  }
  require_fits(units, grid);
  return units;
}

std::vector<Constraint> constraints_in(const Json& request) {
  std::vector<Constraint> where;
  const auto found = request.find("where");
  if (found == request.end()) return where;
  if (!found->is_array() || found->size() > kMostConstraints) unfit("where is not a list of constraints");
  for (const Json& text : *found) {
    if (!text.is_string()) unfit("where holds something that is no text");
    where.push_back(parse_constraint({fmt::format("constraint {}", where.size() + 1), text.get<std::string>()}));
  }
  return where;
}

Conditions conditions_in(const Json& request, const Grid& grid) {
  Conditions conditions{constraints_in(request), units_in(request, grid), flag_in(request, "include_not_settled"),
                        0};
  require_answerable(conditions, grid);
  return conditions;
}

/// Throws InputError when it does not fit the portrait, or needs a plant and has none.
Expression expression_in(const Json& request, const char* key, const Grid& grid, const QueryUnits& units) {
  Expression expression = parse_expression({key, text_in(request, key)});
  require_available(expression, grid, units.plant.has_value());
  return expression;
}

Parameter axis_in(const Json& request, const char* key, const Grid& grid) {
  const auto parameter = parameter_named(text_in(request, key));
  if (!parameter || !has_axis(grid, *parameter)) unfit(fmt::format("{} is no axis of the portrait", key));
  return *parameter;
}

std::vector<std::uint64_t> held_in(const Json& request, const Grid& grid) {
  const auto found = request.find("held");
  if (found == request.end() || !found->is_array() || found->size() != grid.axes.size())
    unfit("held is not a list with an index for every axis");
  std::vector<std::uint64_t> held;
  for (const Json& index : *found) held.push_back(whole(index, "held", grid.axes[held.size()].size()));
  return held;
}

// ---------------------------------------------------------------- answers

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(json_number(value));
  return list;
}

/// Enough digits for a curve on a screen, in a third of the bytes.
Json curve(const std::vector<double>& values, double factor) {
  Json list = Json::array();
  for (const double value : values)
    list.push_back(std::isfinite(value) ? Json(std::stod(fmt::format("{:.6g}", value * factor))) : Json(nullptr));
  return list;
}

/// What query says of a setting, with where it lies in the grid.
Json json_placed(const Grid& grid, const QueryUnits& units, const Found& found) {
  Json json = json_found(grid, units, found);
  json["number"] = found.number;
  json["coordinates"] = coordinates(grid, found.number);
  return json;
}

Json json_answer(const Grid& grid, const Question& question, const Answer& answer) {
  Json active = Json::array();
  for (const ActiveConstraint& a : answer.active)
    active.push_back({{"constraint", a.constraint}, {"objective_without", json_number(a.optimum.objective)}});
  return {{"optimum",
           answer.top.empty() ? Json(nullptr) : json_placed(grid, question.conditions.units, answer.top.front())},
          {"admissible", answer.admissible},
          {"total", answer.total},
          {"left_out", json_left_out(answer.left_out)},
          {"excluded", answer.excluded},
          {"active", active}};
}

std::string packed(const Json& head, const std::vector<double>& values, const CrossSection& section,
                   const std::vector<bool>& admissible) {
  std::string text = head.dump();
  text.append((4 - text.size() % 4) % 4, ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string bytes(sizeof length, '\0');
  std::memcpy(bytes.data(), &length, sizeof length);
  bytes += text;
  std::vector<float> single(values.begin(), values.end());
  bytes.append(reinterpret_cast<const char*>(single.data()), single.size() * sizeof(float));
  for (std::size_t i = 0; i < values.size(); ++i)
    bytes += static_cast<char>(static_cast<int>(section.statuses()[i]) + (admissible[i] ? 8 : 0));
  return bytes;
}

Json json_points(const std::vector<CloudPoint>& points) {
  Json x = Json::array(), y = Json::array(), number = Json::array();
  for (const CloudPoint& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
    number.push_back(p.number);
  }
  return {{"x", x}, {"y", y}, {"number", number}};
}

/// One point of the cloud for each cell of a picture that has any; admissible ones first.
std::vector<CloudPoint> thinned(const std::vector<CloudPoint>& points, bool admissible) {
  std::vector<pictures::Point> places;
  std::vector<CloudPoint> chosen, kept;
  for (const CloudPoint& p : points)
    if (p.admissible == admissible) {
      places.push_back({p.x > 0 ? std::log(p.x) : p.x, p.y > 0 ? std::log(p.y) : p.y});
      chosen.push_back(p);
    }
  for (const std::size_t i : pictures::thinned_positions(places, 90, 60)) kept.push_back(chosen[i]);
  return kept;
}

Json values_at(const Found& found, const Json& expressions, const Grid& grid, const QueryUnits& units) {
  if (!expressions.is_array() || expressions.size() > kMostConstraints) unfit("expressions is not a list");
  std::vector<double> values;
  for (const Json& text : expressions) {
    if (!text.is_string()) unfit("expressions holds something that is no text");
    const Expression expression = parse_expression({"expression", text.get<std::string>()});
    require_available(expression, grid, units.plant.has_value());
    values.push_back(value_at(expression, found.setting, found.measures, units));
  }
  return numbers(values);
}

Horizon shown_horizon(const Loop& loop, const Horizon& horizon) {
  if (!horizon.automatic && horizon.dead_times <= kLongestShown) return horizon;
  SettingMeasured measured;
  if (!is_stable(open_loop(loop))) return Horizon::fixed(30);
  measure_settings(Method::kernel, loop.family, Horizon::until_settled(), {}, {&loop.setting, 1}, {&measured, 1});
  return Horizon::fixed(std::min(measured.horizon, kLongestShown));
}

}  // namespace

Json PageAnswers::info() const {
  const Grid& grid = portrait_.grid();
  const Facts& facts = portrait_.facts();
  Json axes = Json::array(), fixed = Json::object(), measures = Json::array();
  for (const Axis& axis : grid.axes)
    axes.push_back({{"name", axis.name()},
                    {"long_name", portrait::info(axis.parameter()).long_name},
                    {"label", pictures::label(axis.parameter(), grid.family.plant)},
                    {"values", numbers(axis.values())}});
  for (const FixedParameter& p : grid.fixed) fixed[std::string(to_string(p.parameter))] = json_number(p.value);
  for (const Measure m : grid.measures)
    measures.push_back({{"name", to_string(m)},
                        {"long_name", portrait::info(m).long_name},
                        {"unit", pictures::unit_text(portrait::info(m).unit, false)},
                        {"real_unit", pictures::unit_text(portrait::info(m).unit, true)}});
  return {{"title", grid.title},
          {"file", portrait_.path().string()},
          {"plant", to_string(grid.family.plant)},
          {"n", grid.family.n},
          {"prefilter", to_string(grid.family.prefilter)},
          {"horizon", grid.horizon.automatic ? Json("auto") : Json(grid.horizon.dead_times)},
          {"settings", setting_count(grid)},
          {"axes", axes},
          {"fixed", fixed},
          {"measures", measures},
          {"program", facts.program},
          {"history", facts.history},
          {"date_created", facts.date_created},
          {"method", facts.method}};
}

/// Another plane of the same portrait asks the same question: its answer is kept.
Answer PageAnswers::answer(const Question& question, const Json& request) const {
  Json key = Json::array();
  for (const char* part : {"minimize", "where", "plant", "include_not_settled"})
    key.push_back(request.value(part, Json()));
  const std::string asked = key.dump(-1, ' ', false, Json::error_handler_t::replace);
  {
    const std::lock_guard lock(mutex_);
    if (last_ && answered_ == asked) return *last_;
  }
  const Answer found = ask(cache_, question);
  const std::lock_guard lock(mutex_);
  answered_ = asked;
  last_ = found;
  return found;
}

std::string PageAnswers::view(const Json& request) const {
  const Grid& grid = portrait_.grid();
  const Conditions conditions = conditions_in(request, grid);
  const QueryUnits& units = conditions.units;
  const Question question{expression_in(request, "minimize", grid, units), conditions, 1, true};
  const Expression colour = expression_in(request, "colour", grid, units);
  const Parameter x = axis_in(request, "x", grid), y = axis_in(request, "y", grid);
  if (x == y) unfit("x and y are the same axis");
  const Answer answer = this->answer(question, request);
  const CrossSection section(cache_, units, x, y, held_in(request, grid));
  Json head = json_answer(grid, question, answer);
  head["nx"] = section.nx();
  head["ny"] = section.ny();
  return packed(head, section.values(colour), section, section.admissible(question));
}

Json PageAnswers::setting(const Json& request) const {
  const Grid& grid = portrait_.grid();
  const QueryUnits units = units_in(request, grid);
  const Found found = found_at(cache_, units, number_in(request, grid), kNaN);
  Json json = json_placed(grid, units, found);
  if (request.contains("expressions")) json["values"] = values_at(found, request["expressions"], grid, units);
  return json;
}

Json PageAnswers::simulate(const Json& request) const {
  const Grid& grid = portrait_.grid();
  const auto plant = units_in(request, grid).plant;
  const Loop loop{grid.family, setting_at(grid, number_in(request, grid))};
  if (const auto why = why_invalid(loop)) unfit("the portrait's setting is no loop: " + *why);
  const auto responses = pictures::sampled_responses(loop, shown_horizon(loop, grid.horizon), kCurvePoints);
  const double g = plant ? input_gain(*plant) : 1, Td = plant ? plant->Td : 1;
  Json answer = setting(request);
  answer["t"] = curve(responses[0].t, Td);
  answer["y_w"] = curve(responses[0].y, 1);
  answer["u_w"] = curve(responses[0].u, 1 / g);
  answer["y_d"] = curve(responses[1].y, g);
  answer["u_d"] = curve(responses[1].u, 1);
  std::vector<double> re, im;
  for (const pictures::Point& p : pictures::nyquist_curve(loop, 10, 0.03, kNyquistPoints)) {
    re.push_back(p.x);
    im.push_back(p.y);
  }
  answer["re"] = curve(re, 1);
  answer["im"] = curve(im, 1);
  answer["command"] = simulate_command(loop);
  return answer;
}

Json PageAnswers::front(const Json& request) const {
  const Grid& grid = portrait_.grid();
  const Conditions conditions = conditions_in(request, grid);
  const Expression x = expression_in(request, "x_expression", grid, conditions.units);
  const Expression y = expression_in(request, "y_expression", grid, conditions.units);
  const Cloud found = cloud(cache_, x, y, conditions);
  return {{"front", json_points(found.front)},
          {"admissible", json_points(thinned(found.points, true))},
          {"others", json_points(thinned(found.points, false))}};
}

Json PageAnswers::rules(const Json& request) const {
  const Grid& grid = portrait_.grid();
  const Conditions conditions = conditions_in(request, grid);
  const QueryUnits& units = conditions.units;
  const Question question{expression_in(request, "minimize", grid, units), conditions, 1, true};
  const Answer answer = this->answer(question, request);
  std::vector<RuleOnPortrait> rules;
  try {
    rules =
        rules_on(grid, question, answer.top.empty() ? std::nullopt : std::optional(answer.top.front().objective));
  } catch (const InputError& error) {  // no fault of the request: a portrait that rules say nothing of
    return {{"rules", Json::array()}, {"why", error.what()}};
  }
  std::erase_if(rules, [&](const RuleOnPortrait& r) {
    return !r.not_applicable.empty() || !has_what_is_fixed(grid, r.setting);
  });
  Json list = json_rules(grid, question, rules);
  if (request.contains("x_expression") && request.contains("y_expression")) {
    const Expression x = expression_in(request, "x_expression", grid, units);
    const Expression y = expression_in(request, "y_expression", grid, units);
    for (std::size_t k = 0; k < rules.size(); ++k)
      list[k]["place"] = numbers({value_at(x, rules[k].setting, rules[k].measures, units),
                                  value_at(y, rules[k].setting, rules[k].measures, units)});
  }
  return {{"rules", list}, {"why", nullptr}};
}

Json PageAnswers::quantiles(const Json& request) const {
  const Grid& grid = portrait_.grid();
  const Conditions everything{{}, units_in(request, grid), false, 0};
  const Expression expression = expression_in(request, "expression", grid, everything.units);
  std::vector<double> values;
  for (const CloudPoint& p : cloud(cache_, expression, expression, everything).points) values.push_back(p.x);
  std::sort(values.begin(), values.end());
  std::vector<double> quantiles;
  for (std::size_t k = 0; k <= 100 && !values.empty(); ++k)
    quantiles.push_back(values[k * (values.size() - 1) / 100]);
  return {{"quantiles", numbers(quantiles)}};
}

}  // namespace portrait::tools
