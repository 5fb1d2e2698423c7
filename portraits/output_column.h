/// One column of a portrait file being written: a measure or the status.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "grids/grid.h"
#include "portraits/h5.h"
#include "portraits/tile_rows.h"

namespace portrait {

class OutputColumn {
 public:
  static OutputColumn of_measure(const h5::File& file, const Grid& grid, Measure measure);
  static OutputColumn of_status(const h5::File& file, const Grid& grid);

  /// A tile's values as they are to be stored. REQUIRES: each tile once.
  void write(std::uint64_t tile, std::span<const std::byte> bytes);

  /// Reads every tile back, row-major, and adds the digests: of all values to the column, of each tile to the
  /// group of tile digests, on the scale `tile`. Throws StoreError when the file holds other values than were
  /// written.
  void finish(const h5::File& file, const h5::Dataset& tile_scale) const;

 private:
  OutputColumn(h5::Dataset dataset, const Grid& grid);
  std::uint64_t read_back() const;

  h5::Dataset dataset_;
  TileRows rows_;
  std::vector<std::uint64_t> digests_;  ///< of each tile
};

}  // namespace portrait
