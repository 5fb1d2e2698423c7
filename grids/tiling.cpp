#include "grids/tiling.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "engine/base/check.h"

namespace portrait {
namespace {

std::uint64_t product(const std::vector<std::uint64_t>& factors) {
  return std::accumulate(factors.begin(), factors.end(), std::uint64_t{1}, std::multiplies<>());
}

std::uint64_t pieces(std::uint64_t whole, std::uint64_t piece) { return (whole + piece - 1) / piece; }

/// The extent of a tile along an axis when `room` values fit into it. Equal pieces leave no sliver at the edge.
std::uint64_t equal_piece(std::uint64_t size, std::uint64_t room) { return pieces(size, pieces(size, room)); }

std::vector<std::uint64_t> tile_of(const std::vector<std::uint64_t>& extent) {
  std::vector<std::uint64_t> tile(extent.size(), 1);
  std::uint64_t settings = 1;
  for (std::size_t k = extent.size(); k-- > 0;) {
    tile[k] = equal_piece(extent[k], kTileSettings / settings);
    if (tile[k] < extent[k]) break;
    settings *= extent[k];
  }
  return tile;
}

/// values[k][i]: value i of the box along axis k.
std::vector<std::vector<double>> axis_values(const Grid& grid, const Box& box) {
  std::vector<std::vector<double>> values(grid.axes.size());
  for (std::size_t k = 0; k < values.size(); ++k)
    for (std::uint64_t i = 0; i < box.extent[k]; ++i) values[k].push_back(grid.axes[k][box.start[k] + i]);
  return values;
}

/// One step in row-major order, the last axis fastest.
void advance(std::vector<std::uint64_t>& at, const std::vector<std::uint64_t>& extent) {
  for (std::size_t k = at.size(); k-- > 0;) {
    if (++at[k] < extent[k]) return;
    at[k] = 0;
  }
}

}  // namespace

std::uint64_t Box::size() const { return product(extent); }

Tiling::Tiling(const Grid& grid) {
  for (const Axis& axis : grid.axes) extent_.push_back(axis.size());
  tile_extent_ = tile_of(extent_);
}

std::uint64_t Tiling::tile_count() const {
  std::uint64_t count = 1;
  for (std::size_t k = 0; k < extent_.size(); ++k) count *= pieces(extent_[k], tile_extent_[k]);
  return count;
}

Box Tiling::box(std::uint64_t number) const {
  PORTRAIT_CHECK(number < tile_count());
  Box box{std::vector<std::uint64_t>(extent_.size()), std::vector<std::uint64_t>(extent_.size())};
  for (std::size_t k = extent_.size(); k-- > 0;) {
    const std::uint64_t along = pieces(extent_[k], tile_extent_[k]);
    box.start[k] = number % along * tile_extent_[k];
    box.extent[k] = std::min(tile_extent_[k], extent_[k] - box.start[k]);
    number /= along;
  }
  return box;
}

std::vector<Setting> settings_in(const Grid& grid, const Box& box) {
  const auto along = axis_values(grid, box);
  std::vector<Setting> settings(box.size());
  std::vector<std::uint64_t> at(along.size(), 0);
  std::vector<double> values(along.size());
  for (Setting& setting : settings) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = along[k][at[k]];
    setting = setting_with(grid, values);
    advance(at, box.extent);
  }
  return settings;
}

}  // namespace portrait
