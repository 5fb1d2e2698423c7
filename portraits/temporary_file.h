/// A file that appears under its name only when it is complete.
///
/// It is written beside its target under a temporary name, TARGET.tmp-PID-COUNT, brought to the disk, and
/// renamed in one step; then the directory is brought to the disk. Whoever stops before that leaves the
/// target as it was.
#pragma once

#include <filesystem>

namespace portrait {

enum class Existing { refuse, replace };  ///< what to do with a file of the target's name

/// Throws InputError "FILE exists already (--force replaces it)" when it does, or when its directory does
/// not.
void check_target(const std::filesystem::path& target, Existing existing);

/// Syncs the file, renames it to its name, syncs the directory. Throws InputError when the target exists and is to be
/// refused, however late it came.
void give_name(const std::filesystem::path& path, const std::filesystem::path& target, Existing existing);

class TemporaryFile {
 public:
  /// Chooses the name; creating the file is the caller's.
  explicit TemporaryFile(std::filesystem::path target);
  /// Removes the file unless it was published.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& target() const { return target_; }

  /// Syncs, renames, syncs the directory. Throws InputError when the target exists and is to be refused,
  /// however late it came, and StoreError when the system fails. REQUIRES: the file is written and closed.
  void publish(Existing existing);

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  bool published_ = false;
};

}  // namespace portrait
