#include "tools/pictures/stability_limit.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/loop/stability.h"
#include "tools/pictures/key.h"
#include "tools/pictures/simplify.h"

namespace portrait::pictures {
namespace {

constexpr int kHalvings = 20;
constexpr double kInvisible = 1e-4;  // of the picture
constexpr Size kSize{16, 11};

double state(const Loop& loop) {
  if (why_invalid(loop)) return kNaN;
  return is_stable(open_loop(loop)) ? 1 : -1;
}

}  // namespace

Loop Plane::at(double x_value, double y_value) const {
  Loop loop = base;
  const bool x_last = x == Parameter::tau_d;
  set(loop.setting, x_last ? y : x, x_last ? y_value : x_value);
  set(loop.setting, x_last ? x : y, x_last ? x_value : y_value);
  return loop;
}

Field stability(const Plane& plane, std::vector<double> x, std::vector<double> y) {
  Field field{std::move(x), std::move(y), {}};
  for (const double y_value : field.y)
    for (const double x_value : field.x) field.z.push_back(state(plane.at(x_value, y_value)));
  return field;
}

Crossing stability_crossing(const Plane& plane, const Field& field) {
  return [&](std::size_t a, std::size_t b) -> Point {
    Point p = field.point(a), q = field.point(b);
    for (int i = 0; i < kHalvings; ++i) {
      const Point middle{0.5 * (p.x + q.x), 0.5 * (p.y + q.y)};
      (state(plane.at(middle.x, middle.y)) == field.at(a) ? p : q) = middle;
    }
    return {0.5 * (p.x + q.x), 0.5 * (p.y + q.y)};
  };
}

std::vector<Outline> stability_limit(const Plane& plane, const Field& field) {
  return lines_at(field, 0, stability_crossing(plane, field));
}

Script script(const StabilityPicture& picture, const Plane& plane, const Field& field) {
  std::vector<std::string> titles{"stable", "limit of stability"};
  for (const Mark& mark : picture.marks) titles.push_back(mark.label);
  const Key key = key_below(titles, kSize.width_cm);
  Script script({kSize.width_cm, kSize.height_cm + key.height_cm});
  script.line("set title " + quoted(picture.title));
  script.line("set xlabel " + quoted(picture.x_label));
  script.line("set ylabel " + quoted(picture.y_label));
  script.line(key.lines);
  script.line(fmt::format("set xrange {}\nset yrange {}", limits(field.x, false), limits(field.y, false)));
  std::string plots = "plot NaN notitle";
  const auto area = areas_above(field, 0, stability_crossing(plane, field));
  if (!area.empty())
    plots += fmt::format(
        ", {} using 1:2 with filledcurves closed fc rgb '#cfe8f6' fs solid 1 border lc rgb '#cfe8f6' "
        "title 'stable'",
        script.data(area));
  std::vector<Outline> limit;
  for (const Outline& line : stability_limit(plane, field)) limit.push_back(simplified(line, kInvisible));
  if (!limit.empty())
    plots += fmt::format(", {} using 1:2 with lines lw 2 lc rgb '#0072b2' title 'limit of stability'",
                         script.data(limit));
  script.line(plots + marked(script, picture.marks));
  return script;
}

std::vector<double> spread(double from, double to, std::size_t count, bool log) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0;
    values[i] = log ? from * std::pow(to / from, t) : std::lerp(from, to, t);
  }
  return values;
}

}  // namespace portrait::pictures
