#include "tools/pictures/simplify.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace portrait::pictures {
namespace {

double span(const Outline& curve, double Point::*coordinate) {
  double low = INFINITY, high = -INFINITY;
  for (const Point p : curve)
    if (std::isfinite(p.*coordinate)) low = std::min(low, p.*coordinate), high = std::max(high, p.*coordinate);
  return high > low ? high - low : 1;
}

/// From p to the chord a b.
double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
  const double along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2;
  const double t = length2 > 0 ? std::clamp(along, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

Outline simplified(const Outline& curve, double within) {
  if (curve.size() < 3) return curve;
  const double sx = span(curve, &Point::x), sy = span(curve, &Point::y);
  const auto scaled = [&](std::size_t i) { return Point{curve[i].x / sx, curve[i].y / sy}; };
  std::vector<bool> kept(curve.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> stretches{{0, curve.size() - 1}};
  while (!stretches.empty()) {
    const auto [first, last] = stretches.back();
    stretches.pop_back();
    std::size_t farthest = first;
    double most = within;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance(scaled(i), scaled(first), scaled(last));
      if (!(d <= most)) farthest = i, most = std::isnan(d) ? INFINITY : d;
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    stretches.insert(stretches.end(), {{first, farthest}, {farthest, last}});
  }
  Outline fewer;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (kept[i]) fewer.push_back(curve[i]);
  return fewer;
}

}  // namespace portrait::pictures
