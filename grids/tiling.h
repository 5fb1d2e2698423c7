/// A grid cut into tiles: blocks of settings that are computed together and stored as one chunk.
///
/// A tile is a box in the grid. Trailing axes are kept whole as long as the box stays within `kTileSettings`, so a
/// tile reads and writes contiguous rows; the next axis is split into pieces as equal as they can be, and the axes
/// before it into single values. The same box is a chunk of the portrait file. The tiling depends on the extents
/// alone: never on threads, shards or the machine. A grid without axes is one tile of one setting.
#pragma once

#include <cstdint>
#include <vector>

#include "grids/grid.h"

namespace portrait {

inline constexpr std::uint64_t kTileSettings = 4096;

/// A box of settings: first index and extent along each axis.
struct Box {
  std::vector<std::uint64_t> start;
  std::vector<std::uint64_t> extent;
  std::uint64_t size() const;  ///< settings in the box; 1 without axes
};

class Tiling {
 public:
  explicit Tiling(const Grid& grid);

  std::uint64_t tile_count() const;
  /// Tile `number` in row-major order of tiles; those at the far edges may be smaller than `tile_extent`.
  /// REQUIRES: number < tile_count().
  Box box(std::uint64_t number) const;
  /// Extents of a full tile, which is the chunk shape.
  const std::vector<std::uint64_t>& tile_extent() const { return tile_extent_; }

 private:
  std::vector<std::uint64_t> extent_;       ///< of the grid
  std::vector<std::uint64_t> tile_extent_;  ///< of a tile
};

/// The settings of a box, row-major.
std::vector<Setting> settings_in(const Grid& grid, const Box& box);

}  // namespace portrait
