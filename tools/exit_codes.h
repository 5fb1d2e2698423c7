/// What the program's exit code says. Public: scripts rely on it.
#pragma once

namespace portrait::tools {

enum ExitCode {
  kDone = 0,
  kFailure = 1,     ///< disk, HDF5, or our own mistake
  kWrongInput = 2,  ///< wrong usage or wrong input file
  kNoneAdmissible = 3,
  kBroken = 4,        ///< a file's integrity is broken
  kStopped = 5,       ///< stopped with work left
  kInterrupted = 130  ///< interrupted twice
};

}  // namespace portrait::tools
