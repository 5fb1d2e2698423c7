/// Writes a portrait: tiles in any order, then everything at once under its name.
///
///     PortraitWriter writer(path, grid, {command_line, method});
///     for every tile: writer.write(tile, columns);
///     writer.publish({wall_seconds, threads});
///
/// Values are the same bytes in whatever order tiles come. Every NaN is stored as the one quiet NaN, every
/// measure in the grid's precision. A writer that is not published leaves nothing behind.
///
/// errors    InputError: the file exists, or its directory does not. StoreError: disk or HDF5
/// cost      memory: one tile, and 8 bytes per tile and column
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/facts.h"
#include "portraits/temporary_file.h"

namespace portrait {

class PortraitWriter {
 public:
  PortraitWriter(const std::filesystem::path& path, const Grid& grid, const Provenance& provenance,
                 Existing existing = Existing::refuse);
  ~PortraitWriter();

  /// REQUIRES: a tile of Tiling(grid), not written yet; the grid's measures, as many settings as the tile
  /// has.
  void write(std::uint64_t tile, const MeasureColumns& columns);

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
