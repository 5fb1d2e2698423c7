/// Ctrl-C and its kin: the first asks the work to end cleanly, the second ends the program at once with exit code 130.
#pragma once

#include <atomic>

namespace portrait::tools {

/// While one lives, SIGINT, SIGTERM, SIGHUP and SIGUSR1 are caught. REQUIRES: at most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& requested() const;
};

}  // namespace portrait::tools
