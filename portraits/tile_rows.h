/// Tiles as ranges of setting numbers. A tile keeps its trailing axes whole, so it is one run of settings,
/// and tiles in their order follow each other without gaps: reading tile by tile is reading row-major.
///
/// cost      a few divisions per axis
#pragma once

#include <cstdint>
#include <vector>

#include "grids/grid.h"
#include "grids/tiling.h"

namespace portrait {

/// Settings first .. first + count - 1.
struct SettingRange {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  std::uint64_t end() const { return first + count; }
};

class TileRows {
 public:
  explicit TileRows(const Grid& grid);

  std::uint64_t tile_count() const { return tiling_.tile_count(); }
  const std::vector<std::uint64_t>& extent() const { return extent_; }  ///< of the grid
  const std::vector<std::uint64_t>& tile_extent() const { return tiling_.tile_extent(); }
  Box box(std::uint64_t tile) const { return tiling_.box(tile); }

  SettingRange range(std::uint64_t tile) const;
  /// The tile that holds a setting.
  std::uint64_t tile_of(std::uint64_t setting) const;

 private:
  std::vector<std::uint64_t> extent_;
  Tiling tiling_;
};

}  // namespace portrait
