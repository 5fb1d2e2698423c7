/// What is known of a tile whose chunks are in a file: where they lie, and their digests. Whoever has the records of
/// all tiles can make a portrait of the file without looking at a value.
#pragma once

#include <cstdint>
#include <vector>

#include "portraits/chunk_codec.h"

namespace portrait {

/// A column of the tile: a chunk.
struct ChunkRecord {
  std::uint64_t length = 0;       ///< bytes in the file
  ChunkForm form = ChunkForm::plain;
  std::uint64_t digest = 0;       ///< of the values
  std::vector<double> summary{};  ///< portraits/tile_summary.h
  friend bool operator==(const ChunkRecord&, const ChunkRecord&) = default;
};

/// Chunks follow each other without gaps: measures in the grid's order, then the status.
struct TileRecord {
  std::uint64_t number = 0;
  std::uint64_t address = 0;        ///< of the first chunk
  std::uint64_t stored_digest = 0;  ///< of all chunks as they lie in the file
  std::vector<ChunkRecord> chunks;
  friend bool operator==(const TileRecord&, const TileRecord&) = default;
};

/// Bytes of all chunks.
std::uint64_t stored_bytes(const TileRecord& tile);

}  // namespace portrait
