#include "tools/pictures/labels.h"

#include <array>
#include <cmath>
#include <limits>

#include "engine/base/check.h"

namespace portrait::pictures {
namespace {

constexpr double kGap = 1.0;        // between a point and its text, in characters
constexpr double kTextWeight = 20;  // hiding a text is worse than hiding a point, and leaving the panel as bad

struct Box {
  double left, right, bottom, top;
  bool holds(Point p) const { return p.x > left && p.x < right && p.y > bottom && p.y < top; }
  bool meets(const Box& b) const { return left < b.right && b.left < right && bottom < b.top && b.bottom < top; }
};

Box box_at(Point middle, std::size_t width) {
  const double half = 0.5 * static_cast<double>(width) + 0.2;
  return {middle.x - half, middle.x + half, middle.y - 0.5, middle.y + 0.5};
}

/// Around the point, at a distance and at further ones.
std::vector<LabelPlace> places_around(std::size_t width) {
  constexpr std::array<Point, 8> kDirections = {
      {{1, 0.5}, {1, -0.5}, {-1, 0.5}, {-1, -0.5}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<LabelPlace> places;
  for (const double ring : {1.0, 1.8, 3.0})
    for (const Point d : kDirections)
      places.push_back({d.x * (ring * kGap + 0.5 * static_cast<double>(width)), d.y * ring * (kGap + 0.3)});
  return places;
}

struct Scene {
  const std::vector<Point>& at;
  const std::vector<Point>& drawn;
  Point panel;
  std::vector<Box> taken;

  double hidden_by(const Box& box) const {
    double cost = 0;
    if (box.left < 0 || box.right > panel.x || box.bottom < 0 || box.top > panel.y) cost += kTextWeight;
    for (const Box& other : taken) cost += box.meets(other) ? kTextWeight : 0;
    for (const Point p : at) cost += box.holds(p) ? 2 : 0;
    for (const Point p : drawn) cost += box.holds(p) ? 1 : 0;
    return cost;
  }
};

}  // namespace

std::vector<LabelPlace> label_places(const std::vector<Point>& at, const std::vector<std::size_t>& widths,
                                     const std::vector<Point>& drawn, Point panel) {
  PORTRAIT_CHECK_EQ(at.size(), widths.size());
  Scene scene{at, drawn, panel, {}};
  std::vector<LabelPlace> chosen;
  for (std::size_t k = 0; k < at.size(); ++k) {
    LabelPlace best{};
    double least = std::numeric_limits<double>::infinity();
    for (const LabelPlace& place : places_around(widths[k])) {
      const double cost = scene.hidden_by(box_at({at[k].x + place.dx, at[k].y + place.dy}, widths[k]));
      if (cost < least) best = place, least = cost;
    }
    chosen.push_back(best);
    scene.taken.push_back(box_at({at[k].x + best.dx, at[k].y + best.dy}, widths[k]));
  }
  return chosen;
}

}  // namespace portrait::pictures
