/// The end of every way to a portrait: a file that holds the chunks of all tiles becomes an HDF5 file around them. No
/// value is read, moved or encoded again, so this costs a look into HDF5's index for every chunk and no more.
///
/// Then the file is opened as a reader would and checked: grid, facts and tile digests in full, and that HDF5 finds
/// every chunk where it lies. The chunks' bytes were read back when they were written (portraits/data_file.h).
///
/// errors    StoreError: disk or HDF5; what does not read back as written
/// cost      memory: the records. Time: bench/store_rate.cpp
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "grids/grid.h"
#include "portraits/facts.h"
#include "portraits/tile_record.h"

namespace portrait {

/// REQUIRES: `tiles` are all those of the grid, in order; their chunks lie below `end` and beyond the first 512 bytes;
/// nobody else has the file open for writing.
void finish_portrait(const std::filesystem::path& path, std::uint64_t end, const Grid& grid,
                     const Provenance& provenance, const RunFacts& facts, const std::vector<TileRecord>& tiles);

}  // namespace portrait
