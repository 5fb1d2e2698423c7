/// One writer a shard: a lock that the system gives back when its owner dies, and whose file says who that is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace portrait {

class RunLock {
 public:
  /// Throws InputError "... is being written by process 7 on host h, since ..." when another has it.
  explicit RunLock(std::filesystem::path path);
  /// Removes the file.
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Who holds the lock of this file now.
  static std::optional<std::string> owner(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace portrait
