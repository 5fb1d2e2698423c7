/// One column of a portrait file being written: a measure or the status.
#pragma once

#include <cstdint>
#include <vector>

#include "grids/grid.h"
#include "portraits/digest.h"
#include "portraits/tile_record.h"
#include "portraits/h5.h"

namespace portrait {

class OutputColumn {
 public:
  static OutputColumn of_measure(const h5::File& file, const Grid& grid, Measure measure);
  static OutputColumn of_status(const h5::File& file, const Grid& grid);

  /// Enters the next tile, whose bytes are in the file. `start` is its first index along each axis.
  /// REQUIRES: tiles in the order of their numbers.
  void enter(const std::vector<std::uint64_t>& start, const ChunkRecord& chunk, std::uint64_t address);

  /// What the datasets about tiles, made here, have as their dimensions.
  struct TileScales {
    h5::Dataset digests;         ///< tile_digests/tile
    h5::Dataset tile;            ///< tile_summaries/tile
    h5::Dataset range, outcome;  ///< tile_summaries/range, tile_summaries/outcome
  };
  static TileScales create_tile_scales(const h5::File& file, std::uint64_t tiles);

  /// Adds the digests: of all values to the column, of each tile to the group of tile digests; and the summary of
  /// each tile to their group.
  /// REQUIRES: every tile was written.
  void finish(const h5::File& file, const TileScales& scales) const;

 private:
  void finish_summaries(const h5::File& file, const TileScales& scales) const;
  explicit OutputColumn(h5::Dataset dataset) : dataset_(std::move(dataset)) {}

  h5::Dataset dataset_;
  std::vector<std::uint64_t> digests_;  ///< of each tile so far
  std::vector<double> summaries_;       ///< of each tile so far, one after the other
};

}  // namespace portrait
