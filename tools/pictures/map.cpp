#include "tools/pictures/map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tools/pictures/key.h"
#include "tools/pictures/numbered.h"

namespace portrait::pictures {
namespace {

constexpr Size kSize{17, 11.7};
constexpr Point kPanel{62, 20};  // in characters, about
constexpr const char *kStabilityTitle = "limit of stability", *kRegionTitle = "admissible region",
                     *kSettingsTitle = "admissible settings", *kPatchTitle = "the optimum, plant uncertain";
constexpr double kShareInRange = 0.95;

double level(const std::pair<double, double>& range, int k, int levels, bool log) {
  const double t = static_cast<double>(k) / levels;
  if (log) return range.first * std::pow(range.second / range.first, t);
  return std::lerp(range.first, range.second, t);
}

/// With logarithmic colours the function is linear in its logarithm between nodes.
Field levelled(const Field& field, bool log) {
  Field result = field;
  if (log)
    for (double& z : result.z) z = z > 0 ? std::log(z) : NAN;
  return result;
}

/// From the lowest level up, each area painted over the last: neighbouring colours have no seam between them.
std::string areas(Script& script, const Map& map, const std::pair<double, double>& range) {
  const Field field = levelled(map.field, map.log_z);
  std::string plots;
  for (int k = 0; k < map.levels; ++k) {
    const double at = level(range, k, map.levels, map.log_z);
    const double cut = k == 0 ? -INFINITY : map.log_z ? std::log(at) : at;
    const std::vector<Outline> above = areas_above(field, cut, interpolated(field, cut));
    if (above.empty()) continue;
    const std::string colour = palette_colour(map.levels > 1 ? static_cast<double>(k) / (map.levels - 1) : 0);
    plots +=
        fmt::format(", {} using 1:2 with filledcurves closed fc rgb '{}' fs solid 1 border lc rgb '{}' notitle",
                    script.data(above), colour, colour);
  }
  return plots;
}

void scale(Script& script, const Map& map, const std::pair<double, double>& range) {
  script.line(palette(map.levels));
  script.line(fmt::format("set cbrange [{:.8g}:{:.8g}]", range.first, range.second));
  script.line("set cblabel " + quoted(map.z_label) + " offset 1");
  // Every second border of a band carries its value.
  std::string tics;
  const int step = std::max(1, map.levels / 6);
  for (int k = 0; k <= map.levels; k += step) {
    const double at = level(range, k, map.levels, map.log_z);
    tics += fmt::format("{}'{:.3g}' {:.8g}", k > 0 ? ", " : "", at, at);
  }
  script.line("set cbtics (" + tics + ")");
  if (map.log_z) script.line("set logscale cb");
}

std::string overlay(Script& script, const Map& map) {
  std::string plots;
  if (!map.stability.empty())
    plots += fmt::format(", {} using 1:2 with lines lw 1.5 lc rgb '#d55e00' dt 2 title '{}'",
                         script.data(map.stability), kStabilityTitle);
  if (!map.admissible.empty())
    plots += fmt::format(", {} using 1:2 with lines lw 2.2 lc rgb 'black' title '{}'", script.data(map.admissible),
                         kRegionTitle);
  if (!map.admissible_settings.empty())
    plots += fmt::format(", {} using 1:2 with points pt 6 ps 0.7 lw 1.2 lc rgb 'black' title '{}'",
                         script.data({map.admissible_settings}), kSettingsTitle);
  if (!map.patch.empty())
    plots += fmt::format(", {} using 1:2 with lines lw 2 lc rgb '#a40000' dt 2 title '{}'", script.data(map.patch),
                         kPatchTitle);
  plots += marked(script, map.marks);
  if (map.optimum)
    plots += fmt::format(", {} using 1:2 with points pt 3 ps 1.8 lw 2.6 lc rgb '#d00000' title {}",
                         script.data({{map.optimum->at}}), quoted(map.optimum->label));
  return plots;
}

}  // namespace

std::string marked(Script& script, const std::vector<Mark>& marks) {
  std::string plots;
  for (std::size_t k = 0; k < marks.size(); ++k)
    plots +=
        fmt::format(", {} using 1:2 with points pt {} ps 1.3 lw 2 lc rgb 'black' title {}",
                    script.data({{marks[k].at}}), std::array{1, 2, 8, 4, 10, 12}[k % 6], quoted(marks[k].label));
  return plots;
}

std::string limits(const std::vector<double>& values, bool log) {
  double low = values.front(), high = values.back();
  if (low == high) {
    low = log ? low / 2 : low - 1;
    high = log ? high * 2 : high + 1;
  }
  return fmt::format("[{:.10g}:{:.10g}]", low, high);
}

std::pair<double, double> usual_range(const Field& field) {
  std::vector<double> finite;
  for (const double z : field.z)
    if (std::isfinite(z)) finite.push_back(z);
  if (finite.empty()) return {0, 1};
  std::sort(finite.begin(), finite.end());
  const double low = finite.front();
  double high = finite[static_cast<std::size_t>(kShareInRange * static_cast<double>(finite.size() - 1))];
  if (!(high > low)) high = finite.back();
  if (!(high > low)) high = low + std::max(1e-6, std::abs(low) * 1e-6);
  return {low, high};
}

bool spreads(const std::pair<double, double>& range) { return range.first > 0 && range.second > 8 * range.first; }

namespace {

std::vector<std::string> titles_of(const Map& map) {
  std::vector<std::string> titles;
  if (!map.stability.empty()) titles.emplace_back(kStabilityTitle);
  if (!map.admissible.empty()) titles.emplace_back(kRegionTitle);
  if (!map.admissible_settings.empty()) titles.emplace_back(kSettingsTitle);
  if (!map.patch.empty()) titles.emplace_back(kPatchTitle);
  for (const Mark& mark : map.marks) titles.push_back(mark.label);
  if (map.optimum) titles.push_back(map.optimum->label);
  for (const Mark& mark : map.rules) titles.push_back("12  " + mark.label);
  return titles;
}

std::string rules(Script& script, const Map& map) {
  if (map.rules.empty()) return "";
  const auto span = [](const std::vector<double>& values, bool log) {
    return Span{values.front(), values.back(), log};
  };
  std::vector<Point> drawn = map.admissible_settings;
  for (const Mark& mark : map.marks) drawn.push_back(mark.at);
  if (map.optimum) drawn.push_back(map.optimum->at);
  for (const auto* lines : {&map.admissible, &map.stability, &map.patch})
    for (const Outline& line : *lines) drawn.insert(drawn.end(), line.begin(), line.end());
  script.line("set style textbox opaque noborder margins 0.2,0.2");
  return numbered(script, map.rules, span(map.field.x, map.field.log_x), span(map.field.y, map.field.log_y), kPanel,
                  drawn);
}

}  // namespace

Script script(const Map& map) {
  const Key key = key_below(titles_of(map), kSize.width_cm);
  Script script({kSize.width_cm, kSize.height_cm + key.height_cm});
  const auto range = map.range.value_or(usual_range(map.field));
  script.line("set title " + quoted(map.title));
  script.line("set xlabel " + quoted(map.x_label));
  script.line("set ylabel " + quoted(map.y_label));
  script.line(key.lines);
  script.line(fmt::format("set xrange {}\nset yrange {}", limits(map.field.x, map.field.log_x),
                          limits(map.field.y, map.field.log_y)));
  if (map.field.log_x) script.line("set logscale x");
  if (map.field.log_y) script.line("set logscale y");
  scale(script, map, range);
  const std::string plots = areas(script, map, range) + overlay(script, map) + rules(script, map);
  // Nothing to see, but it brings the scale of colours.
  script.line("plot NaN with points palette notitle" + plots);
  return script;
}

}  // namespace portrait::pictures
