#include "portraits/disk.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/error.h"

namespace portrait::disk {
namespace {

std::atomic<Hook> g_hook = nullptr;

/// Closed when it goes; the errno of what failed stays.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : number_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    const int reason = errno;
    if (number_ >= 0) close(number_);
    errno = reason;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

void sync(const std::filesystem::path& path, int flags) {
  const Descriptor file(path, flags);
  if (file.number() < 0) failed(path, "open it to sync it");
  // Some file systems have nothing to sync a directory with, and say so with EINVAL.
  if ((!may("sync") || fsync(file.number()) != 0) && !(errno == EINVAL && (flags & O_DIRECTORY) != 0))
    failed(path, "sync it");
}

void write_all(const Descriptor& file, const std::filesystem::path& path, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = may("write") ? write(file.number(), bytes.data() + done, bytes.size() - done) : -1;
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) failed(path, "write it");
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace

void set_hook(Hook hook) { g_hook = hook; }

bool may(const char* call) {
  const Hook hook = g_hook;
  const int error = hook != nullptr ? hook(call) : 0;
  if (error != 0) errno = error;
  return error == 0;
}

void failed(const std::filesystem::path& path, const char* doing) {
  throw StoreError(fmt::format("{}: cannot {}: {}", path.string(), doing, std::strerror(errno)));
}

std::filesystem::path directory_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

void sync_file(const std::filesystem::path& path) { sync(path, O_RDONLY); }

void sync_directory(const std::filesystem::path& path) { sync(path, O_RDONLY | O_DIRECTORY); }

void rename(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (!may("rename") || std::rename(from.c_str(), to.c_str()) != 0) failed(to, "rename to it");
}

// Not every file system can rename without replacing; a second link is refused just as surely.
bool rename_unless_there(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (may("rename") && renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
  if (errno != EINVAL && errno != ENOSYS) failed(to, "rename to it");
  if (may("rename") && link(from.c_str(), to.c_str()) == 0) {
    unlink(from.c_str());
    return true;
  }
  if (errno == EEXIST) return false;
  failed(to, "link to it");
}

void remove(const std::filesystem::path& path) {
  if (!may("remove") || (::remove(path.c_str()) != 0 && errno != ENOENT)) failed(path, "remove it");
}

namespace {

/// Of no other process, on this machine or another with the same disk.
std::filesystem::path temporary_of(const std::filesystem::path& path) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("{}.{}-{}.tmp", path.string(), getpid(), host.data());
}

std::filesystem::path synced_temporary(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::path temporary = temporary_of(path);
  {
    const Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    if (file.number() < 0) failed(temporary, "create it");
    write_all(file, temporary, bytes);
    if (!may("sync") || fsync(file.number()) != 0) failed(temporary, "sync it");
  }
  if (read_whole_file(temporary) != bytes)
    throw StoreError(fmt::format("{}: the disk does not give back what was written to it", temporary.string()));
  return temporary;
}

}  // namespace

void write_whole_file(const std::filesystem::path& path, const std::string& bytes) {
  disk::rename(synced_temporary(path, bytes), path);
  sync_directory(directory_of(path));
}

bool write_new_file(const std::filesystem::path& path, const std::string& bytes) {
  const std::filesystem::path temporary = synced_temporary(path, bytes);
  const bool is_new = rename_unless_there(temporary, path);
  if (is_new)
    sync_directory(directory_of(path));
  else
    disk::remove(temporary);
  return is_new;
}

std::string read_whole_file(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  if (file.number() < 0) failed(path, "open it");
  std::string bytes;
  char piece[65536];
  while (true) {
    const ssize_t count = read(file.number(), piece, sizeof piece);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) failed(path, "read it");
    if (count == 0) return bytes;
    bytes.append(piece, static_cast<std::size_t>(count));
  }
}

}  // namespace portrait::disk
