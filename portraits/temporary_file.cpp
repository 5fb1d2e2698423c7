#include "portraits/temporary_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/error.h"

namespace portrait {
namespace {

[[noreturn]] void system_failed(const std::filesystem::path& path, const char* doing) {
  throw StoreError(fmt::format("{}: cannot {}: {}", path.string(), doing, std::strerror(errno)));
}

[[noreturn]] void refuse(const std::filesystem::path& target) {
  throw InputError(fmt::format("{} exists already (--force replaces it)", target.string()));
}

std::filesystem::path directory_of(const std::filesystem::path& target) {
  return target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
}

std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<int> count = 0;
  return target.string() + fmt::format(".tmp-{}-{}", getpid(), count++);
}

void sync(const std::filesystem::path& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) system_failed(path, "open it to sync it");
  const int failed = fsync(descriptor);
  const int reason = errno;
  close(descriptor);
  errno = reason;
  // Some file systems have nothing to sync a directory with, and say so with EINVAL.
  if (failed != 0 && !(errno == EINVAL && (flags & O_DIRECTORY) != 0)) system_failed(path, "sync it");
}

/// Not every file system can rename without replacing; a second link is refused just as surely.
void rename_unless_there(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno == EEXIST) refuse(to);
  if (errno != EINVAL && errno != ENOSYS) system_failed(to, "rename to it");
  if (link(from.c_str(), to.c_str()) == 0) {
    unlink(from.c_str());
    return;
  }
  if (errno == EEXIST) refuse(to);
  system_failed(to, "link to it");
}

}  // namespace

void check_target(const std::filesystem::path& target, Existing existing) {
  if (!std::filesystem::is_directory(directory_of(target)))
    throw InputError(fmt::format("{}: there is no directory {}", target.string(), directory_of(target).string()));
  if (existing == Existing::refuse && std::filesystem::exists(std::filesystem::symlink_status(target)))
    refuse(target);
}

TemporaryFile::TemporaryFile(std::filesystem::path target)
    : target_(std::move(target)), path_(temporary_name(target_)) {}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!published_) std::filesystem::remove(path_, ignored);
}

void TemporaryFile::publish(Existing existing) {
  sync(path_, O_RDONLY);
  if (existing == Existing::refuse)
    rename_unless_there(path_, target_);
  else if (std::rename(path_.c_str(), target_.c_str()) != 0)
    system_failed(target_, "rename to it");
  published_ = true;
  sync(directory_of(target_), O_RDONLY | O_DIRECTORY);
}

}  // namespace portrait
