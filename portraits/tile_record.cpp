#include "portraits/tile_record.h"

namespace portrait {
namespace {

ChunkRecord record_of(const EncodedColumn& column) {
  return {column.stored().size(), column.form(), column.digest(), column.summary()};
}

}  // namespace

TileRecord record_of(const EncodedTile& tile, std::uint64_t address) {
  TileRecord record{tile.number, address, tile.stored_digest, {}};
  record.chunks.reserve(tile.measures.size() + 1);
  for (const EncodedColumn& column : tile.measures) record.chunks.push_back(record_of(column));
  record.chunks.push_back(record_of(tile.status));
  return record;
}

std::uint64_t stored_bytes(const TileRecord& tile) {
  std::uint64_t bytes = 0;
  for (const ChunkRecord& chunk : tile.chunks) bytes += chunk.length;
  return bytes;
}

}  // namespace portrait
