#include "tools/pictures/characteristic.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tools/pictures/key.h"
#include "tools/pictures/labels.h"

namespace portrait::pictures {
namespace {

constexpr Size kSize{20, 10};
constexpr Point kPanel{37, 17};  // a panel in characters, about
constexpr std::array<int, 6> kSymbols = {7, 5, 9, 11, 13, 6};

using Deviation = double CharacteristicAt::*;

bool drawn_at(const CharacteristicAt& p, Deviation deviation) {
  return std::isfinite(p.speed) && std::isfinite(p.*deviation);
}

/// Pieces of the curve between its gaps.
std::vector<Outline> pieces(const CharacteristicCurve& curve, Deviation deviation) {
  std::vector<Outline> all(1);
  for (const CharacteristicAt& p : curve.points) {
    if (drawn_at(p, deviation))
      all.back().push_back({p.*deviation, p.speed});
    else if (!all.back().empty())
      all.emplace_back();
  }
  if (all.back().empty()) all.pop_back();
  return all;
}

/// What a panel shows: deviations from 0 on, with room for the texts.
struct Window {
  double x1 = 0, y0 = INFINITY, y1 = -INFINITY;

  bool is_empty() const { return !(y0 <= y1); }
  Point in_characters(Point p) const { return {p.x / x1 * kPanel.x, (p.y - y0) / (y1 - y0) * kPanel.y}; }
};

Window window(const Characteristics& picture, Deviation deviation) {
  Window w;
  for (const CharacteristicCurve& curve : picture.curves)
    for (const Outline& piece : pieces(curve, deviation))
      for (const Point p : piece) {
        w.x1 = std::max(w.x1, p.x);
        w.y0 = std::min(w.y0, p.y);
        w.y1 = std::max(w.y1, p.y);
      }
  const double room = w.y1 > w.y0 ? 0.12 * (w.y1 - w.y0) : std::max(0.1 * std::abs(w.y1), 1e-12);
  return {w.x1 > 0 ? 1.25 * w.x1 : 1, w.y0 - room, w.y1 + room};
}

struct Named {
  Point at;
  std::string text;
  std::size_t curve;
};

/// The first and the last point of each curve.
std::vector<Named> ends(const Characteristics& picture, Deviation deviation) {
  std::vector<Named> all;
  for (std::size_t k = 0; k < picture.curves.size(); ++k) {
    const CharacteristicAt *first = nullptr, *last = nullptr;
    for (const CharacteristicAt& p : picture.curves[k].points)
      if (drawn_at(p, deviation)) (first ? last : first) = &p;
    for (const CharacteristicAt* p : {first, last})
      if (p) all.push_back({{p->*deviation, p->speed}, p->value, k});
  }
  return all;
}

/// Every curve as points half a character apart, which texts should not hide.
std::vector<Point> drawn_points(const Characteristics& picture, Deviation deviation, const Window& w) {
  std::vector<Point> points;
  for (const CharacteristicCurve& curve : picture.curves)
    for (const Outline& piece : pieces(curve, deviation))
      for (std::size_t i = 1; i < piece.size(); ++i) {
        const Point a = w.in_characters(piece[i - 1]), b = w.in_characters(piece[i]);
        const int steps = 1 + static_cast<int>(2 * std::hypot(b.x - a.x, b.y - a.y));
        for (int s = 0; s <= steps; ++s)
          points.push_back({std::lerp(a.x, b.x, 1.0 * s / steps), std::lerp(a.y, b.y, 1.0 * s / steps)});
      }
  return points;
}

void name_ends(Script& script, const Characteristics& picture, Deviation deviation, const Window& w) {
  const std::vector<Named> all = ends(picture, deviation);
  std::vector<Point> at;
  std::vector<std::size_t> widths;
  for (const Named& n : all) {
    at.push_back(w.in_characters(n.at));
    widths.push_back(n.text.size());
  }
  const auto places = label_places(at, widths, drawn_points(picture, deviation, w), kPanel);
  for (std::size_t k = 0; k < all.size(); ++k)
    script.line(fmt::format("set label {} at {:.8g},{:.8g} center offset {:.3g},{:.3g} tc rgb '{}'",
                            quoted(all[k].text), all[k].at.x, all[k].at.y, places[k].dx, places[k].dy,
                            curve_colour(all[k].curve)));
}

void panel(Script& script, const Characteristics& picture, Deviation deviation, const std::string& x_label) {
  script.line("unset label\nset xlabel " + quoted(x_label) + "\nset ylabel " + quoted(picture.speed_label));
  const Window w = window(picture, deviation);
  if (!w.is_empty()) {
    script.line(fmt::format("set xrange [0:{:.8g}]\nset yrange [{:.8g}:{:.8g}]", w.x1, w.y0, w.y1));
    name_ends(script, picture, deviation, w);
  }
  std::string plots = "plot NaN notitle";
  for (std::size_t k = 0; k < picture.curves.size(); ++k) {
    const CharacteristicCurve& curve = picture.curves[k];
    const std::vector<Outline> drawn = pieces(curve, deviation);
    if (drawn.empty()) continue;
    plots += fmt::format(", {} using 1:2 with linespoints {} pt {} ps 0.8 title {}", script.data(drawn),
                         curve_style(k), kSymbols[k % kSymbols.size()], quoted(curve.label));
  }
  script.line(plots);
}

}  // namespace

Script script(const Characteristics& picture) {
  std::vector<std::string> titles;
  for (const CharacteristicCurve& curve : picture.curves) titles.push_back(curve.label);
  const Key key = key_below(titles, kSize.width_cm);
  Script script({kSize.width_cm, kSize.height_cm + key.height_cm});
  script.line("set multiplot layout 1,2 title " + quoted(picture.title));
  script.line(key.lines);  // one for both panels
  panel(script, picture, &CharacteristicAt::effort, picture.effort_label);
  script.line("unset key");
  panel(script, picture, &CharacteristicAt::wobbling, picture.wobbling_label);
  script.line("unset multiplot");
  return script;
}

}  // namespace portrait::pictures
