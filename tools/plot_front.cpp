/// portrait plot front: two objectives against each other, and what lies on their Pareto front.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/sweep/method.h"
#include "grids/sweep_job.h"
#include "portraits/query/cloud.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/pictures/front.h"
#include "tools/pictures/text.h"
#include "tools/plot_arguments.h"
#include "tools/plot_rules.h"
#include "tools/plot_verb.h"
#include "tools/portrait_pictures.h"
#include "tools/shown_portrait.h"

namespace portrait::tools {
namespace {

constexpr const char* kFrontHelp =
    R"(Example:
  portrait plot front huba.h5 --x Ms --y 'IAE_w + IAE_d' --where 'Ms <= 3' -o front.svg

Two expressions against each other, both better when smaller: the settings, and the Pareto
front of those that meet --where. --setting marks others, measured on the spot, and --rules the tuning
rules, numbered, each with the factor by which its y is above the least of the front.)";

constexpr std::size_t kColumns = 110, kRows = 80;

/// The conditions alone: x stands in for what a question minimizes.
Conditions conditions(const FrontArguments& a, const ShownPortrait& shown) {
  PlotArguments with_x = a;
  with_x.minimize = a.x;
  return question_argument(with_x, shown.grid()).conditions;
}

pictures::Mark mark(const std::string& text, const ShownPortrait& shown, const Expression& x, const Expression& y) {
  const Grid& grid = shown.grid();
  const auto named = named_loop(text, grid.family, fixed_setting(grid));
  SettingMeasured measured;
  measure_settings(method_for(grid.measures), grid.family, grid.horizon, extras_for(grid), {&named.loop.setting, 1},
                   {&measured, 1});
  for (const Measure m : all_measures()) measured.measures[m] *= factor(m, shown.units);
  const auto at = [&](const Expression& e) {
    return value_at(e, named.loop.setting, measured.measures, shown.units);
  };
  return {{at(x), at(y)}, named.label};
}

/// A little beyond where admissible settings lie in x; without any, no limit.
double right_end(const Cloud& cloud) {
  double low = INFINITY, high = -INFINITY;
  for (const auto* points : {&cloud.points, &cloud.front})
    for (const CloudPoint& p : *points)
      if (p.admissible) low = std::min(low, p.x), high = std::max(high, p.x);
  return low <= high ? high + 0.15 * (high - low) : INFINITY;
}

/// Points of the picture: those within its 97 % in y, so that the wall next to instability does not take the room.
std::vector<pictures::Point> cloud_points(const Cloud& cloud) {
  const double right = right_end(cloud);
  std::vector<double> heights;
  for (const CloudPoint& p : cloud.points) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  const double most = heights.empty() ? 0 : heights[heights.size() * 97 / 100];
  std::vector<pictures::Point> points;
  for (const CloudPoint& p : cloud.points)
    if (p.y <= most && p.x <= right) points.push_back({p.x, p.y});
  return pictures::thinned(points, kColumns, kRows);
}

/// Rules within the picture; their regret is that of y against the least on the front.
std::vector<pictures::Mark> front_rules(const pictures::Front& picture, const FrontArguments& a,
                                        const ShownPortrait& shown, const Expression& x, const Expression& y) {
  const Question question{y, conditions(a, shown), 1, false};
  const auto best = picture.front.empty() ? std::nullopt : std::optional(picture.front.back().y);
  double right = -INFINITY, top = -INFINITY;
  for (const auto* points : {&picture.settings, &picture.front})
    for (const pictures::Point p : *points) right = std::max(right, p.x), top = std::max(top, p.y);
  return rule_marks(
      shown.grid(), rules_on(shown.grid(), question, best), question,
      [&](const RuleOnPortrait& r) -> pictures::Point {
        return {value_at(x, r.setting, r.measures, shown.units), value_at(y, r.setting, r.measures, shown.units)};
      },
      [&](pictures::Point p) { return p.x <= right && p.y <= top; });
}

}  // namespace

PortraitPicture front_picture(const FrontArguments& a) {
  const ShownPortrait shown(a.file, a.plant);
  const Expression x = parse_expression({"--x", a.x}), y = parse_expression({"--y", a.y});
  const Cloud found = cloud(shown.portrait, x, y, conditions(a, shown));
  pictures::Front picture;
  picture.title = a.title.empty() ? (shown.grid().title.empty() ? a.file : shown.grid().title) : a.title;
  picture.x_label = pictures::label(x, shown.has_plant());
  picture.y_label = pictures::label(y, shown.has_plant());
  picture.log_x = is_log(a, "x");
  picture.log_y = is_log(a, "y");
  picture.settings = cloud_points(found);
  for (const CloudPoint& p : found.front) picture.front.push_back({p.x, p.y});
  for (const std::string& text : a.settings) picture.marks.push_back(mark(text, shown, x, y));
  if (a.rules) picture.rules = front_rules(picture, a, shown, x, y);
  return {picture.title, pictures::script(picture), !found.front.empty()};
}

namespace {

int front(const FrontArguments& a, const Invocation& invocation) {
  const PortraitPicture picture = front_picture(a);
  pictures::draw(picture.script, a.output, about(picture.title, invocation.command_line));
  if (picture.complete) return kDone;
  print_message("no setting is admissible; drawn without a front");
  return kNoneAdmissible;
}

}  // namespace

void add_plot_front(CLI::App& plot, Invocation& invocation) {
  auto a = std::make_shared<FrontArguments>();
  CLI::App* kind =
      add_verb(plot, "front", "two expressions against each other, with their Pareto front", kFrontHelp);
  kind->add_option("file", a->file, "portrait file")->required();
  add_output(*kind, *a);
  kind->add_option("--x", a->x, "an expression, small being good")->required();
  kind->add_option("--y", a->y, "another")->required();
  add_many(*kind, "--where", a->where, "a constraint on the front, EXPR <= X; any number of times");
  kind->add_flag("--include-not-settled", a->include_not_settled,
                 "also settings whose responses had not settled at the horizon");
  kind->add_option("--plant", a->plant, "K=..,Td=..[,T1=..]: measures in the units of this plant");
  add_many(*kind, "--setting", a->settings, "LABEL: kappa=.. tau_i=..: a setting to mark; any number of times");
  kind->add_flag("--rules", a->rules, "tuning rules that lie in the picture, numbered, with their regret in --y");
  add_log(*kind, *a, "x, y: logarithmic scales, with a comma between them");
  kind->callback([a, &invocation] { invocation.exit_code = front(*a, invocation); });
}

}  // namespace portrait::tools
