#include "portraits/tile_record.h"

namespace portrait {
std::uint64_t stored_bytes(const TileRecord& tile) {
  std::uint64_t bytes = 0;
  for (const ChunkRecord& chunk : tile.chunks) bytes += chunk.length;
  return bytes;
}

}  // namespace portrait
