/// Which shard of a grid this process computes.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "portraits/run_folder.h"

namespace portrait::tools {

/// "3/16": part 3 of 16. Throws InputError.
Shard shard_argument(const std::string& text);

/// A variable of the environment; nothing when it is not set.
using Environment = std::function<std::optional<std::string>(const char* name)>;
Environment this_environment();

/// From what Open MPI, MPICH and Intel MPI (PMI), srun, and the array of a Slurm job say: ranks within an array task
/// count within it. {1, 1} when none of them says anything. Throws InputError when what they say does not fit together.
Shard shard_from(const Environment& environment);

}  // namespace portrait::tools
