#include "portraits/tile_rows.h"

#include "engine/base/check.h"

namespace portrait {
namespace {

std::vector<std::uint64_t> sizes(const Grid& grid) {
  std::vector<std::uint64_t> found;
  for (const Axis& axis : grid.axes) found.push_back(axis.size());
  return found;
}

/// From the last axis: whole ones, then one in pieces, then single values.
bool is_one_run(const std::vector<std::uint64_t>& extent, const std::vector<std::uint64_t>& tile) {
  std::size_t k = extent.size();
  while (k > 0 && tile[k - 1] == extent[k - 1]) --k;
  for (std::size_t before = 0; before + 1 < k; ++before)
    if (tile[before] != 1) return false;
  return true;
}

}  // namespace

TileRows::TileRows(const Grid& grid) : extent_(sizes(grid)), tiling_(grid) {
  PORTRAIT_CHECK_EQ(tile_extent().size(), extent_.size());
  PORTRAIT_CHECK(is_one_run(extent_, tile_extent()));
}

SettingRange TileRows::range(std::uint64_t tile) const {
  const Box box = tiling_.box(tile);
  std::uint64_t first = 0;
  for (std::size_t k = 0; k < extent_.size(); ++k) first = first * extent_[k] + box.start[k];
  return {first, box.size()};
}

std::uint64_t TileRows::tile_of(std::uint64_t setting) const {
  std::uint64_t tile = 0, tiles = 1;
  for (std::size_t k = extent_.size(); k-- > 0;) {
    const std::uint64_t piece = tile_extent()[k];
    tile += setting % extent_[k] / piece * tiles;
    tiles *= (extent_[k] + piece - 1) / piece;
    setting /= extent_[k];
  }
  return tile;
}

}  // namespace portrait
