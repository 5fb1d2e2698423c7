/// A measured tile as a portrait stores it: every column in the grid's precision, with one NaN, as a chunk with its
/// filters applied, and its digest. Made by the worker that measured the tile; HDF5 has no part in it.
///
/// What a chunk becomes depends on its values alone, so the file has the same bytes for any number of threads.
///
/// cost      memory: the tile's values once more, at most. Time: bench/store_rate.cpp
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/data_file.h"
#include "portraits/tile_record.h"
#include "portraits/tile_rows.h"

namespace portrait {

struct EncodedTile {
  TileRecord record;  ///< without its address, which whoever puts the chunks down knows
  Piece chunks;       ///< one behind the other
};

/// REQUIRES: a tile of the grid, with the grid's measures and the tile's settings.
EncodedTile encode_tile(const Grid& grid, const TileRows& rows, std::uint64_t tile, const MeasureColumns& columns);

}  // namespace portrait
