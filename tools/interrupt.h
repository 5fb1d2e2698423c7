/// Ctrl-C and its kin: the first asks the work to end cleanly, the second ends the program at once with exit code 130.
#pragma once

#include <atomic>
#include <string>

namespace portrait::tools {

/// While one lives, SIGINT, SIGTERM and SIGHUP are caught. REQUIRES: at most one at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& requested() const;

  /// A file that the second signal removes before the program ends.
  void remove_on_second(const std::string& path);
};

}  // namespace portrait::tools
