/// A batch: tiles that were brought to the disk together. Its file lists where their chunks lie in the data file of its
/// shard, with all their digests. A tile is stored when a valid batch lists it, and never before: the set of valid
/// batches is the truth about a run.
///
/// shape     magic, fingerprint of the run, end of the data, tiles; then XXH3 of all that: one byte changed anywhere and
///           the file is no batch (tests/portraits/run_folder_test.cpp)
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "portraits/tile_record.h"

namespace portrait {

struct Batch {
  std::uint64_t fingerprint = 0;  ///< of the run
  std::uint64_t data_end = 0;     ///< where the next batch begins in the data file
  std::vector<TileRecord> tiles;
};

/// Temporary file, sync, read back, rename, sync of the directory. REQUIRES: the data is synced.
void write_batch(const std::filesystem::path& path, const Batch& batch);

/// Or what is wrong with it.
std::variant<Batch, std::string> read_batch(const std::filesystem::path& path, std::uint64_t fingerprint);

}  // namespace portrait
