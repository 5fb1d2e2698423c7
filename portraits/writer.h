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
/// cost      memory: 8 bytes per tile and column. Time: bench/store_rate.cpp
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/encoded_tile.h"
#include "portraits/facts.h"
#include "portraits/temporary_file.h"

namespace portrait {

class PortraitWriter {
 public:
  PortraitWriter(const std::filesystem::path& path, const Grid& grid, const Provenance& provenance,
                 Existing existing = Existing::refuse);
  ~PortraitWriter();

  /// Any number of threads may encode while another writes. REQUIRES: a tile of Tiling(grid); the grid's measures,
  /// as many settings as the tile has.
  EncodedTile encode(std::uint64_t tile, const MeasureColumns& columns) const;
  /// REQUIRES: the next tile of all.
  void write(const EncodedTile& tile);

  std::uint64_t tiles_left() const;

  /// Where the file grows until it is published.
  const std::filesystem::path& temporary_path() const { return temporary_.path(); }

  /// Adds digests and facts, closes the file, checks all of it as a reader sees it, and gives it its name.
  /// REQUIRES: no tile is left; called once.
  void publish(const RunFacts& facts);

 private:
  class File;
  TemporaryFile temporary_;  ///< outlives the open file
  Existing existing_;
  std::unique_ptr<File> file_;
};

}  // namespace portrait
