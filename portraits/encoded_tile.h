/// A measured tile as a portrait stores it: every column in the grid's precision, with one NaN, as a chunk with its
/// filters applied, and its digest. Made by the worker that measured the tile; HDF5 has no part in it.
///
/// What a chunk becomes depends on its values alone, so the file has the same bytes for any number of threads.
///
/// cost      memory: the tile's values once more. Time: bench/store_rate.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/chunk_codec.h"
#include "portraits/tile_rows.h"
#include "portraits/tile_summary.h"

namespace portrait {

/// A column of a tile.
class EncodedColumn {
 public:
  /// `values` are those of the tile as they are stored; a tile at the far edge is padded with `fill` to a whole
  /// chunk. `summary` is what tile_summary.h makes of the values.
  /// REQUIRES: fill.size() is the size of a value, and chunk_values at least the number of values.
  EncodedColumn(std::vector<std::byte> values, std::vector<double> summary, std::span<const std::byte> fill,
                std::size_t chunk_values);

  std::span<const std::byte> values() const { return std::span(plain_).first(value_bytes_); }
  ChunkForm form() const { return deflated_.empty() ? ChunkForm::plain : ChunkForm::deflated; }
  std::span<const std::byte> stored() const { return deflated_.empty() ? plain_ : deflated_; }
  std::uint64_t digest() const { return digest_; }  ///< of the values
  const std::vector<double>& summary() const { return summary_; }

 private:
  std::vector<std::byte> plain_;  ///< the values, padded and checksummed
  std::size_t value_bytes_;
  std::uint64_t digest_;
  std::vector<double> summary_;
  std::vector<std::byte> deflated_;  ///< the same deflated; empty: it is stored plain
};

struct EncodedTile {
  std::uint64_t number = 0;
  std::vector<EncodedColumn> measures;  ///< those of the grid
  EncodedColumn status;
  std::uint64_t stored_digest = 0;  ///< of all chunks one after the other, as they are stored
};

/// REQUIRES: a tile of the grid, with the grid's measures and the tile's settings.
EncodedTile encode_tile(const Grid& grid, const TileRows& rows, std::uint64_t tile, const MeasureColumns& columns);

}  // namespace portrait
