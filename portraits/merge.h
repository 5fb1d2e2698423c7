/// Makes one portrait of the shards of a grid, wherever they were computed. Nothing is decoded: chunks are copied, each
/// tile held against its digest on the way.
///
/// A tile that several shards have must be the same bytes in each. Missing ones are named by the shards that owe them.
///
/// result    the values, digests and chunks of the run that was never split
/// errors    InputError: folders of different runs, tiles missing. IntegrityError: damage, or duplicates that differ
/// cost      memory: the records of all tiles (about 2 KB a tile of 4096 settings), and the chunks of a few
///           (portraits/data_file.h). Time: bench/store_rate.cpp
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "portraits/facts.h"
#include "portraits/run_folder.h"
#include "portraits/temporary_file.h"

namespace portrait {

struct MergeReport {
  std::uint64_t settings = 0, tiles = 0, bytes = 0;
  int shards = 0;
  std::uint64_t duplicates = 0;  ///< tiles found more than once, all equal
};

MergeReport merge_runs(const std::vector<RunFolder>& folders, const std::filesystem::path& target, Existing existing,
                       const RunFacts& facts, const std::string& command_line);

}  // namespace portrait
