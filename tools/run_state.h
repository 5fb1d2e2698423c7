/// What is known of a run that is going on, was stopped, or consists of shards.
#pragma once

#include <string>

#include "portraits/run_folder.h"

namespace portrait::tools {

/// The run folder that a user means by FILE.h5 or FILE.h5.run; nothing when there is a file, or no such folder.
std::optional<RunFolder> run_folder_meant(const std::string& name);

/// To stdout: state, progress and health, of every shard. Gives back the exit code.
int print_run_state(const RunFolder& folder, bool json);

/// Every chunk of every batch held against its digest. Gives back the exit code.
int verify_run(const RunFolder& folder);

}  // namespace portrait::tools
