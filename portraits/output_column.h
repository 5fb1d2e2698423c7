/// One column of a portrait file being written: a measure or the status.
#pragma once

#include <cstdint>
#include <vector>

#include "grids/grid.h"
#include "portraits/digest.h"
#include "portraits/encoded_tile.h"
#include "portraits/h5.h"

namespace portrait {

class OutputColumn {
 public:
  static OutputColumn of_measure(const h5::File& file, const Grid& grid, Measure measure);
  static OutputColumn of_status(const h5::File& file, const Grid& grid);

  /// The next tile. `start` is its first index along each axis. REQUIRES: tiles in the order of their numbers.
  void write(const std::vector<std::uint64_t>& start, const EncodedColumn& column);

  /// Adds the digests: of all values to the column, of each tile to the group of tile digests, on the scale `tile`.
  /// REQUIRES: every tile was written.
  void finish(const h5::File& file, const h5::Dataset& tile_scale) const;

 private:
  explicit OutputColumn(h5::Dataset dataset) : dataset_(std::move(dataset)) {}

  h5::Dataset dataset_;
  Digest whole_;                        ///< of all values so far, row-major
  std::vector<std::uint64_t> digests_;  ///< of each tile so far
};

}  // namespace portrait
