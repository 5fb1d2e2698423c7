/// A sweep into its portrait: begun, stopped, gone on with, or one shard of it.
#pragma once

#include <string>

#include "engine/sweep/method.h"
#include "grids/grid.h"
#include "portraits/earlier_portrait.h"
#include "portraits/run_folder.h"

namespace portrait::tools {

struct SweepArguments {
  std::string grid, output, shard, extend;
  Method method = Method::kernel;
  int threads = 0;
  bool dry_run = false, force = false, quiet = false, json = false, resume = false;
};

/// `earlier`: the portrait that --extend names, or nullptr. Gives back the exit code.
int sweep_to_file(const SweepArguments& arguments, const std::string& command_line, const Grid& grid,
                  const Shard& shard, int threads, EarlierPortrait* earlier);

}  // namespace portrait::tools
