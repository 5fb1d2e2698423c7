#include "portraits/run_lock.h"

#include <array>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/disk.h"
#include "portraits/facts.h"

namespace portrait {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on {}, since {}", getpid(), host.data(), date_text());
}

/// Whether the path still names the file that is open: its owner removes it in the end.
bool is_still(const std::filesystem::path& path, int descriptor) {
  struct stat open_one {}, named {};
  return fstat(descriptor, &open_one) == 0 && stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

/// Whoever only looks at the lock has it for a moment.
bool locked(int descriptor) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK) return false;
    usleep(20'000);
  }
  errno = EWOULDBLOCK;
  return false;
}

std::string words_in(int descriptor) {
  std::array<char, 512> words{};
  const ssize_t count = pread(descriptor, words.data(), words.size() - 1, 0);
  return count > 0 ? std::string(words.data(), static_cast<std::size_t>(count)) : "another process";
}

}  // namespace

RunLock::RunLock(std::filesystem::path path) : path_(std::move(path)) {
  while (true) {
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) disk::failed(path_, "create it");
    if (!locked(descriptor_)) {
      const int reason = errno;
      const std::string owner = words_in(descriptor_);
      close(descriptor_);
      errno = reason;
      if (reason != EWOULDBLOCK) disk::failed(path_, "lock it");
      throw InputError(fmt::format("{} is being written by {}", path_.string(), owner));
    }
    if (is_still(path_, descriptor_)) break;
    close(descriptor_);
  }
  const std::string words = this_process();
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, words.data(), words.size(), 0) < 0)
    disk::failed(path_, "write it");
}

RunLock::~RunLock() {
  unlink(path_.c_str());
  close(descriptor_);
}

std::optional<std::string> RunLock::owner(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  std::optional<std::string> found;
  if (flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) found = words_in(descriptor);
  close(descriptor);
  return found;
}

}  // namespace portrait
