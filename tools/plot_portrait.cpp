/// portrait plot map: a plane of a portrait.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/cross_section.h"
#include "portraits/query/grid_values.h"
#include "portraits/query/plant_box.h"
#include "portraits/query/query_units.h"
#include "portraits/query/robust.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/pictures/stability_limit.h"
#include "tools/pictures/text.h"
#include "tools/plot_arguments.h"
#include "tools/plot_rules.h"
#include "tools/plot_verb.h"
#include "tools/portrait_pictures.h"
#include "tools/shown_portrait.h"

namespace portrait::tools {
namespace {

using pictures::Point;

constexpr const char* kMapHelp =
    R"(Example:
  portrait plot map huba.h5 --minimize 'IAE_w + IAE_d' --where 'TV2_ud <= 0.1' -o map.svg
  portrait plot map huba.h5 --x kappa --y tau_i --at delta=0.7 --colour Ms --stability -o Ms.png

A plane of a portrait as filled contours of an expression, with the admissible region of
--where and the optimum of --minimize. Axes that are not drawn are held at --at, else where
the optimum lies, else in their middle. --rules adds tuning rules as numbered points, seen along
those axes, with the factor by which each is worse than the optimum.)";

/// In the units of the shown plant, which --uncertain may have given.
Question question_on(const MapArguments& a, const ShownPortrait& shown) {
  Question question = question_argument(a, shown.grid());
  question.conditions.units = shown.units;
  return question;
}

/// The optimum that query gives; for every plant of the box when there is one.
std::optional<Found> optimum(const MapArguments& a, const ShownPortrait& shown,
                             const std::optional<PlantBox>& box) {
  if (a.minimize.empty()) return std::nullopt;
  const Question question = question_on(a, shown);
  if (box) {
    const RobustAnswer answer =
        ask_robust(shown.portrait, {.minimize = question.minimize, .conditions = question.conditions, .box = *box});
    if (answer.top.empty()) return std::nullopt;
    return answer.top.front().nominal;
  }
  const Answer answer = ask(shown.portrait, question);
  if (answer.top.empty()) return std::nullopt;
  return answer.top.front();
}

/// --uncertain; its nominal plant becomes the shown one.
std::optional<PlantBox> box_argument(const MapArguments& a, ShownPortrait& shown) {
  if (a.uncertain.empty()) return std::nullopt;
  if (a.minimize.empty())
    throw InputError("--uncertain needs --minimize: the optimum is the controller whose box is drawn");
  const PlantBox box = uncertain_argument("--uncertain", a.uncertain, shown.units.plant, shown.grid().family.plant);
  shown.units.plant = box.nominal;
  require_fits(shown.units, shown.grid());
  return box;
}

Parameter axis_argument(const char* option, const std::string& text, const Grid& grid, std::size_t usual) {
  std::vector<std::string_view> names;
  for (const Axis& axis : grid.axes) names.push_back(axis.name());
  if (grid.axes.size() < 2)
    throw InputError(
        fmt::format("a map needs two axes; the portrait has {}", names.empty() ? "none" : joined(names)));
  if (text.empty()) return grid.axes[usual].parameter();
  if (std::find(names.begin(), names.end(), text) == names.end())
    throw InputError(fmt::format("{}: \"{}\" is no axis of the portrait{}", option, text, suggestion(text, names)));
  return *parameter_named(text);
}

/// An axis to use beside another one.
std::size_t other_than(const Grid& grid, const std::string& name) {
  return !grid.axes.empty() && grid.axes[0].name() == name ? 1 : 0;
}

void hold(const Grid& grid, const std::string& text, std::vector<std::uint64_t>& held) {
  const ParameterRange value = range_argument("--at", text);
  if (!has_axis(grid, value.parameter))
    throw InputError(fmt::format("--at: {} is no axis of the portrait", to_string(value.parameter)));
  const std::size_t k = axis_index(grid, value.parameter);
  const std::vector<double> values = grid.axes[k].values();
  const auto index = index_of_value(values, value.from);
  if (!index)
    throw InputError(fmt::format("--at: {} is no value of {} (nearest: {})", number_text(value.from),
                                 grid.axes[k].name(), nearest_values(values, value.from)));
  held[k] = *index;
}

std::vector<std::uint64_t> held_indices(const MapArguments& a, const ShownPortrait& shown,
                                        const std::optional<Found>& best) {
  const Grid& grid = shown.grid();
  std::vector<std::uint64_t> held;
  if (best)
    held = coordinates(grid, best->number);
  else
    for (const Axis& axis : grid.axes) held.push_back(axis.size() / 2);
  if (const auto slice = slice_of(shown.units, grid)) {
    const std::size_t lag = axis_index(grid, lag_parameter(grid.family.plant).value());
    held[lag] = *index_of_value(grid.axes[lag].values(), *slice);
  }
  for (const std::string& text : a.at) hold(grid, text, held);
  return held;
}

/// What is said of the axes that do not run: ", tau_i = 8, delta = 0.7".
std::string held_text(const Grid& grid, Parameter x, Parameter y, const std::vector<std::uint64_t>& held) {
  std::string text;
  for (std::size_t k = 0; k < held.size(); ++k)
    if (grid.axes[k].parameter() != x && grid.axes[k].parameter() != y)
      text += fmt::format(", {} = {}", grid.axes[k].name(), number_text(grid.axes[k][held[k]]));
  return text;
}

/// The part of a section that can be drawn: tau_i = inf has no place on an axis.
pictures::Field field_of(const CrossSection& section, const std::vector<double>& z) {
  pictures::Field field;
  const auto finite = [](double value) { return std::isfinite(value); };
  std::copy_if(section.x_values().begin(), section.x_values().end(), std::back_inserter(field.x), finite);
  std::copy_if(section.y_values().begin(), section.y_values().end(), std::back_inserter(field.y), finite);
  for (std::size_t j = 0; j < field.y.size(); ++j)
    for (std::size_t i = 0; i < field.x.size(); ++i) field.z.push_back(z[j * section.nx() + i]);
  return field;
}

bool only_inequalities(const Question& question) {
  return std::none_of(question.conditions.where.begin(), question.conditions.where.end(),
                      [](const Constraint& constraint) { return constraint.relation == Relation::equal; });
}

constexpr std::size_t kMostSettingsDrawn = 1500;

void add_admissible(pictures::Map& map, const CrossSection& section, const Question& question) {
  if (question.conditions.where.empty()) return;
  if (only_inequalities(question)) {
    pictures::Field violation = field_of(section, section.violation(question));
    violation.log_x = map.field.log_x;
    violation.log_y = map.field.log_y;
    map.admissible = lines_at(violation, 0, pictures::interpolated(violation, 0));
  }
  const std::vector<bool> admissible = section.admissible(question);
  for (std::size_t i = 0; i < admissible.size(); ++i)
    if (admissible[i])
      map.admissible_settings.push_back(
          {section.x_values()[i % section.nx()], section.y_values()[i / section.nx()]});
  if (map.admissible_settings.size() > kMostSettingsDrawn) map.admissible_settings.clear();
}

Point place(const Setting& setting, Parameter x, Parameter y) { return {get(setting, x), get(setting, y)}; }

/// Whether a setting lies in the plane that is drawn.
bool in_plane(const Grid& grid, std::uint64_t number, Parameter x, Parameter y,
              const std::vector<std::uint64_t>& held) {
  const auto at = coordinates(grid, number);
  for (std::size_t k = 0; k < at.size(); ++k)
    if (grid.axes[k].parameter() != x && grid.axes[k].parameter() != y && at[k] != held[k]) return false;
  return true;
}

void add_stability(pictures::Map& map, const Grid& grid, Parameter x, Parameter y,
                   const std::vector<std::uint64_t>& held) {
  const pictures::Plane plane{{grid.family, setting_at(grid, held)}, x, y};
  constexpr std::size_t kNodes = 161;
  const auto nodes = [&](const std::vector<double>& values, bool log) {
    return pictures::spread(values.front(), values.back(), kNodes, log);
  };
  const auto stable =
      pictures::stability(plane, nodes(map.field.x, map.field.log_x), nodes(map.field.y, map.field.log_y));
  map.stability = pictures::stability_limit(plane, stable);
}

/// The edges of the box of plants as the controller sees them.
std::vector<pictures::Outline> patch_outline(const PlantBox& box, const Loop& loop, Parameter x, Parameter y) {
  constexpr int kSteps = 24;
  std::vector<pictures::Outline> edges;
  const std::vector<std::size_t> wide = box.uncertain();
  for (const BoxPoint& corner : box.corners())
    for (const std::size_t along : wide) {
      if (corner[along] > 0) continue;  // each edge once, from its low end
      pictures::Outline& edge = edges.emplace_back();
      for (int i = 0; i <= kSteps; ++i) {
        BoxPoint at = corner;
        at[along] = static_cast<double>(i) / kSteps;
        const Point p = place(seen_by(box.at(at), loop, box.nominal), x, y);
        if (std::isfinite(p.x) && std::isfinite(p.y)) edge.push_back(p);
      }
    }
  return edges;
}

bool is_within(const std::vector<double>& values, double value) {
  return value >= values.front() && value <= values.back();
}

/// Rules where they lie in the plane, seen along the axes that are held.
void add_rules(pictures::Map& map, const MapArguments& a, const ShownPortrait& shown,
               const std::optional<Found>& best, Parameter x, Parameter y) {
  const Question question = question_on(a, shown);
  const auto rules = rules_on(shown.grid(), question, best ? std::optional(best->objective) : std::nullopt);
  map.rules = rule_marks(
      shown.grid(), rules, question, [&](const RuleOnPortrait& r) { return place(r.setting, x, y); },
      [&](Point p) { return is_within(map.field.x, p.x) && is_within(map.field.y, p.y); });
}

}  // namespace

PortraitPicture map_picture(const MapArguments& a) {
  ShownPortrait shown(a.file, a.plant);
  const Grid& grid = shown.grid();
  const std::optional<PlantBox> box = box_argument(a, shown);
  const Parameter x = axis_argument("--x", a.x, grid, other_than(grid, a.y));
  const Parameter y = axis_argument("--y", a.y, grid, other_than(grid, std::string(to_string(x))));
  if (x == y) throw InputError("--x and --y name the same axis");
  if (a.colour.empty() && a.minimize.empty()) throw InputError("nothing to draw: give --colour or --minimize");
  if (a.rules && a.minimize.empty()) throw InputError("--rules needs --minimize, which the regret is about");
  if (!a.where.empty() && a.minimize.empty()) throw InputError("--where needs --minimize");
  const auto best = optimum(a, shown, box);
  const auto held = held_indices(a, shown, best);
  const CrossSection section(shown.portrait, shown.units, x, y, held);
  const Expression colour = parse_expression({"--colour", a.colour.empty() ? a.minimize : a.colour});
  require_available(colour, grid, shown.has_plant());

  pictures::Map picture;
  picture.field = field_of(section, section.values(colour));
  picture.field.log_x = is_log(a, "x");
  picture.field.log_y = is_log(a, "y");
  const auto range = picture.range.emplace(pictures::usual_range(picture.field));
  picture.log_z = is_log(a, "colour") || (a.log.empty() && pictures::spreads(range));
  picture.levels = a.levels;
  picture.title = a.title.empty()
                      ? fmt::format("{}{}", grid.title.empty() ? a.file : grid.title, held_text(grid, x, y, held))
                      : a.title;
  picture.x_label = pictures::label(x, grid.family.plant);
  picture.y_label = pictures::label(y, grid.family.plant);
  picture.z_label = pictures::label(colour, shown.has_plant());
  if (!a.minimize.empty()) add_admissible(picture, section, question_on(a, shown));
  if (a.stability) add_stability(picture, grid, x, y, held);
  if (best && in_plane(grid, best->number, x, y, held))
    picture.optimum =
        pictures::Mark{place(best->setting, x, y), fmt::format("optimum, {}", short_number(best->objective))};
  if (box && best) picture.patch = patch_outline(*box, {grid.family, best->setting}, x, y);
  if (a.rules) add_rules(picture, a, shown, best, x, y);
  for (const std::string& text : a.settings) {
    const auto named = named_loop(text, grid.family, fixed_setting(grid));
    picture.marks.push_back({place(named.loop.setting, x, y), named.label});
  }
  return {picture.title, pictures::script(picture), a.minimize.empty() || best.has_value()};
}

namespace {

int map(const MapArguments& a, const Invocation& invocation) {
  const PortraitPicture picture = map_picture(a);
  pictures::draw(picture.script, a.output, about(picture.title, invocation.command_line));
  if (picture.complete) return kDone;
  print_message("no setting is admissible; drawn without optimum");
  return kNoneAdmissible;
}

}  // namespace

void add_plot_map(CLI::App& plot, Invocation& invocation) {
  auto a = std::make_shared<MapArguments>();
  CLI::App* kind =
      add_verb(plot, "map", "a plane of a portrait as filled contours, with region and optimum", kMapHelp);
  kind->add_option("file", a->file, "portrait file")->required();
  add_output(*kind, *a);
  kind->add_option("--x", a->x, "axis to the right (default: the first)");
  kind->add_option("--y", a->y, "axis upwards (default: the next)");
  kind->add_option("--colour,--color", a->colour, "what the colours show: an expression (default: --minimize)");
  kind->add_option("--levels", a->levels, "how many colours")->check(CLI::Range(2, 64))->capture_default_str();
  add_many(*kind, "--at", a->at, "NAME=VALUE of an axis that is held; any number of times");
  add_question(*kind, *a);
  kind->add_option("--plant", a->plant, "K=..,Td=..[,T1=..]: measures in the units of this plant");
  add_many(*kind, "--setting", a->settings, "LABEL: kappa=.. tau_i=..: a setting to mark; any number of times");
  add_log(*kind, *a, "x, y, colour: logarithmic scales, with commas between them");
  kind->add_flag("--rules", a->rules, "tuning rules that lie in the picture, numbered, with their regret");
  kind->add_option(
      "--uncertain", a->uncertain,
      "K=lo..hi,Td=lo..hi[,T1=lo..hi]: the optimum for every plant of this box, and where its controller goes");
  kind->add_flag("--stability", a->stability, "draw the limit of stability, computed on the spot");
  kind->callback([a, &invocation] { invocation.exit_code = map(*a, invocation); });
}

}  // namespace portrait::tools
