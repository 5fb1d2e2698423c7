#include "tools/pictures/front.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tools/pictures/key.h"
#include "tools/pictures/numbered.h"

namespace portrait::pictures {
namespace {

constexpr Size kSize{19, 11};
constexpr Point kPanel{72, 16};  // in characters, about

/// What is reachable: between two points of the front one has to take the worse x for the better y.
Outline staircase(const Outline& front) {
  Outline steps;
  for (std::size_t k = 0; k < front.size(); ++k) {
    if (k > 0) steps.push_back({front[k].x, front[k - 1].y});
    steps.push_back(front[k]);
  }
  return steps;
}

std::size_t cell(double value, double low, double high, std::size_t cells) {
  if (!(high > low)) return 0;
  const double share = (value - low) / (high - low);
  return std::min(cells - 1, static_cast<std::size_t>(share * static_cast<double>(cells)));
}

}  // namespace

std::vector<std::size_t> thinned_positions(const std::vector<Point>& points, std::size_t columns,
                                           std::size_t rows) {
  if (points.empty()) return {};
  const auto [x0, x1] =
      std::minmax_element(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x; });
  const auto [y0, y1] =
      std::minmax_element(points.begin(), points.end(), [](Point a, Point b) { return a.y < b.y; });
  std::vector<bool> taken(columns * rows, false);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t at =
        cell(points[i].y, y0->y, y1->y, rows) * columns + cell(points[i].x, x0->x, x1->x, columns);
    if (!taken[at]) kept.push_back(i);
    taken[at] = true;
  }
  return kept;
}

std::vector<Point> thinned(const std::vector<Point>& points, std::size_t columns, std::size_t rows) {
  std::vector<Point> kept;
  for (const std::size_t i : thinned_positions(points, columns, rows)) kept.push_back(points[i]);
  return kept;
}

namespace {

/// As far as points, front and marks go, and a little further.
Span span_of(const Front& front, double Point::*coordinate, bool log) {
  Span span{INFINITY, -INFINITY, log};
  const auto take = [&](Point p) {
    span.low = std::min(span.low, p.*coordinate);
    span.high = std::max(span.high, p.*coordinate);
  };
  for (const Point p : front.settings) take(p);
  for (const Point p : front.front) take(p);
  for (const Mark& mark : front.marks) take(mark.at);
  for (const Mark& mark : front.rules) take(mark.at);
  if (!(span.low <= span.high)) return {0, 1, false};
  if (log) return {span.low / 1.08, span.high * 1.08, true};
  const double room = span.high > span.low ? 0.05 * (span.high - span.low) : 0.5;
  return {span.low - (front.rules.empty() ? 1 : 2.5) * room, span.high + room, false};  // room for numbers below
}

std::vector<std::string> titles_of(const Front& front) {
  std::vector<std::string> titles{"Pareto front"};
  if (!front.settings.empty()) titles.emplace_back("settings");
  for (const Mark& mark : front.marks) titles.push_back(mark.label);
  for (const Mark& mark : front.rules) titles.push_back("12  " + mark.label);
  return titles;
}

std::string rules(Script& script, const Front& front, Span x, Span y) {
  if (front.rules.empty()) return "";
  script.line("set style textbox opaque noborder margins 0.2,0.2");
  return numbered(script, front.rules, x, y, kPanel, staircase(front.front));
}

}  // namespace

Script script(const Front& front) {
  const Key key = key_below(titles_of(front), kSize.width_cm);
  Script script({kSize.width_cm, kSize.height_cm + key.height_cm});
  const Span x = span_of(front, &Point::x, front.log_x), y = span_of(front, &Point::y, front.log_y);
  script.line("set title " + quoted(front.title));
  script.line("set xlabel " + quoted(front.x_label));
  script.line("set ylabel " + quoted(front.y_label));
  script.line(key.lines);
  script.line(fmt::format("set xrange [{:.8g}:{:.8g}]\nset yrange [{:.8g}:{:.8g}]", x.low, x.high, y.low, y.high));
  if (front.log_x) script.line("set logscale x");
  if (front.log_y) script.line("set logscale y");
  std::string plots = "plot NaN notitle";
  if (!front.settings.empty())
    plots += fmt::format(", {} using 1:2 with points pt 7 ps 0.25 lc rgb '#bbbbbb' title 'settings'",
                         script.data({front.settings}));
  plots += fmt::format(", {} using 1:2 with lines lw 1.6 lc rgb '#0072b2' title 'Pareto front'",
                       script.data({staircase(front.front)}));
  plots +=
      fmt::format(", {} using 1:2 with points pt 7 ps 0.6 lc rgb '#0072b2' notitle", script.data({front.front}));
  for (std::size_t k = 0; k < front.marks.size(); ++k)
    plots += fmt::format(", {} using 1:2 with points pt {} ps 1.5 lw 2 lc rgb '{}' title {}",
                         script.data({{front.marks[k].at}}), std::array{5, 9, 11, 13, 3, 2}[k % 6],
                         curve_colour(k + 1), quoted(front.marks[k].label));
  script.line(plots + rules(script, front, x, y));
  return script;
}

}  // namespace portrait::pictures
