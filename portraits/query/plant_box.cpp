#include "portraits/query/plant_box.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "portraits/query/grid_values.h"

namespace portrait {
namespace {

std::array<Range, 3> ranges_of(const PlantBox& box) { return {box.K, box.Td, box.T1}; }

/// Exact at both ends.
double between(const Range& range, double part) {
  return part == 0 ? range.low : part == 1 ? range.high : range.low + part * (range.high - range.low);
}

/// The values of a parameter that the grid has: from least to greatest.
std::optional<Range> held(const Grid& grid, Parameter parameter) {
  for (const Axis& axis : grid.axes)
    if (axis.parameter() == parameter) return Range{axis[0], axis[axis.size() - 1]};
  for (const FixedParameter& fixed : grid.fixed)
    if (fixed.parameter == parameter) return Range{fixed.value, fixed.value};
  return std::nullopt;
}

bool leaves(const Range& held, double low, double high) {
  const auto below = [](double a, double b) { return a < b && !same_number(a, b); };
  return below(low, held.low) || below(held.high, high);
}

std::optional<std::string> why_range_invalid(std::string_view name, const Range& range, double nominal) {
  if (!(range.low <= range.high))
    return fmt::format("{}={}..{}: the low end comes first", name, number_text(range.low), number_text(range.high));
  if (!range.contains(nominal))
    return fmt::format("the nominal {} = {} lies outside {}..{}", name, number_text(nominal),
                       number_text(range.low), number_text(range.high));
  return std::nullopt;
}

}  // namespace

std::string_view name_of_uncertain(Plant family, std::size_t which) {
  return std::array<std::string_view, 3>{"K", "Td", lag_name(family)}.at(which);
}

std::vector<std::size_t> PlantBox::uncertain() const {
  std::vector<std::size_t> wide;
  const auto ranges = ranges_of(*this);
  for (std::size_t k = 0; k < ranges.size(); ++k)
    if (ranges[k].is_wide()) wide.push_back(k);
  return wide;
}

RealPlant PlantBox::at(const BoxPoint& point) const {
  return {nominal.family, between(K, point[0]), between(Td, point[1]), between(T1, point[2])};
}

std::vector<BoxPoint> PlantBox::corners() const {
  std::vector<BoxPoint> all = {{0, 0, 0}};
  for (const std::size_t k : uncertain())
    for (std::size_t i = 0, before = all.size(); i < before; ++i) {
      all.push_back(all[i]);
      all.back()[k] = 1;
    }
  return all;
}

std::vector<BoxPoint> PlantBox::middles(std::size_t count) const {
  const std::vector<std::size_t> wide = uncertain();
  if (wide.empty()) return {{0, 0, 0}};
  const double root = std::pow(static_cast<double>(count), 1.0 / static_cast<double>(wide.size()));
  const auto each = static_cast<std::size_t>(std::lround(root));
  std::vector<BoxPoint> all = {{0, 0, 0}};
  for (const std::size_t k : wide) {
    std::vector<BoxPoint> more;
    for (const BoxPoint& point : all)
      for (std::size_t i = 0; i < each; ++i) {
        more.push_back(point);
        more.back()[k] = (static_cast<double>(i) + 0.5) / static_cast<double>(each);
      }
    all = more;
  }
  return all;
}

std::optional<std::string> why_invalid(const PlantBox& box) {
  const RealPlant& n = box.nominal;
  if (auto why = why_range_invalid("K", box.K, n.K)) return why;
  if (auto why = why_range_invalid("Td", box.Td, n.Td)) return why;
  if (auto why = why_range_invalid(lag_name(n.family), box.T1, n.T1)) return why;
  if (box.K.low <= 0 && box.K.high >= 0)
    return fmt::format("K={}..{} holds 0: no controller serves a gain that may vanish or change its sign",
                       number_text(box.K.low), number_text(box.K.high));
  for (const BoxPoint& corner : box.corners())
    if (auto why = why_invalid(box.at(corner))) return why;
  return why_invalid(n);
}

Setting seen_by(const RealPlant& plant, const Loop& loop, const RealPlant& nominal) {
  return normalised(controller_for(loop, nominal), plant, loop.family);
}

std::vector<Extent> patch_of(const Grid& grid, const PlantBox& box, const Setting& setting) {
  std::vector<Extent> patch;
  for (const Parameter parameter : parameters_of(grid.family)) {
    Extent extent{parameter, kInf, -kInf, false};
    for (const BoxPoint& corner : box.corners()) {
      const double value = get(seen_by(box.at(corner), {grid.family, setting}, box.nominal), parameter);
      extent.low = std::min(extent.low, value);
      extent.high = std::max(extent.high, value);
    }
    if (same_number(extent.low, extent.high)) continue;
    if (const auto range = held(grid, parameter)) extent.leaves_grid = leaves(*range, extent.low, extent.high);
    patch.push_back(extent);
  }
  return patch;
}

}  // namespace portrait
