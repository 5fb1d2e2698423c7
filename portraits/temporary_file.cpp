#include "portraits/temporary_file.h"

#include <atomic>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/disk.h"

namespace portrait {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& target) {
  throw InputError(fmt::format("{} exists already (--force replaces it)", target.string()));
}

std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<int> count = 0;
  return target.string() + fmt::format(".tmp-{}-{}", getpid(), count++);
}

}  // namespace

void check_target(const std::filesystem::path& target, Existing existing) {
  const std::filesystem::path directory = disk::directory_of(target);
  if (!std::filesystem::is_directory(directory))
    throw InputError(fmt::format("{}: there is no directory {}", target.string(), directory.string()));
  if (existing == Existing::refuse && std::filesystem::exists(std::filesystem::symlink_status(target)))
    refuse(target);
}

void give_name(const std::filesystem::path& path, const std::filesystem::path& target, Existing existing) {
  disk::sync_file(path);
  if (existing == Existing::replace)
    disk::rename(path, target);
  else if (!disk::rename_unless_there(path, target))
    refuse(target);
  disk::sync_directory(disk::directory_of(target));
}

TemporaryFile::TemporaryFile(std::filesystem::path target)
    : target_(std::move(target)), path_(temporary_name(target_)) {}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  if (!published_) std::filesystem::remove(path_, ignored);
}

void TemporaryFile::publish(Existing existing) {
  give_name(path_, target_, existing);
  published_ = true;
}

}  // namespace portrait
