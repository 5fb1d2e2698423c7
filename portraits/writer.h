/// Writes a portrait: tile by tile, then everything at once under its name.
///
///     PortraitWriter writer(path, grid, {command_line, method});
///     for every tile: writer.write(writer.encode(tile, columns));
///     writer.publish({wall_seconds, threads});
///
/// Encoding is most of the work, and may be done by many threads at once; writing is for one at a time, in the
/// order of the tiles, so that a file has the same bytes whoever encoded its tiles. Every NaN is stored as the one
/// quiet NaN, every measure in the grid's precision. A writer that is not published leaves nothing behind.
///
/// errors    InputError: the file exists, or its directory does not. StoreError: disk or HDF5
/// cost      memory: a record per tile, and some tiles (portraits/data_file.h). Time: bench/store_rate.cpp
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/data_file.h"
#include "portraits/encoded_tile.h"
#include "portraits/facts.h"
#include "portraits/temporary_file.h"
#include "portraits/tile_record.h"

namespace portrait {

/// Puts the chunks of a tile down and says where they lie.
TileRecord append_tile(DataFile& file, EncodedTile tile);

class PortraitWriter {
 public:
  PortraitWriter(const std::filesystem::path& path, const Grid& grid, const Provenance& provenance,
                 Existing existing = Existing::refuse);

  /// Any number of threads may encode while another writes. REQUIRES: a tile of Tiling(grid); the grid's measures,
  /// as many settings as the tile has.
  EncodedTile encode(std::uint64_t tile, const MeasureColumns& columns) const;
  /// REQUIRES: the next tile of all.
  void write(EncodedTile tile);

  std::uint64_t tiles_left() const { return rows_.tile_count() - tiles_.size(); }

  /// Where the file grows until it is published.
  const std::filesystem::path& temporary_path() const { return temporary_.path(); }

  /// Makes an HDF5 file of what was written, checks it as a reader sees it, and gives it its name.
  /// REQUIRES: no tile is left; called once.
  void publish(const RunFacts& facts);

 private:
  TemporaryFile temporary_;  ///< outlives the open file
  Existing existing_;
  Grid grid_;
  TileRows rows_;
  Provenance provenance_;
  std::unique_ptr<DataFile> data_;
  std::vector<TileRecord> tiles_;
};

}  // namespace portrait
