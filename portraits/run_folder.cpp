#include "portraits/run_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <regex>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/disk.h"
#include "portraits/run_lock.h"

namespace portrait {
namespace {

struct FileName {
  Shard shard;
  std::string kind;  ///< "data", "batch", "bad", "lock", ...
  int number = 0;    ///< of a batch
};

/// Nothing for a file that is not of a shard.
std::optional<FileName> parsed(const std::string& name) {
  static const std::regex pattern(R"((\d{1,9})-of-(\d{1,9})(?:\.(\d{1,9}))?\.(\w+)(?:\..+\.tmp)?)");
  std::smatch found;
  if (!std::regex_match(name, found, pattern)) return std::nullopt;
  return FileName{{std::stoi(found[1]), std::stoi(found[2])},
                  found[4],
                  found[3].matched ? std::stoi(found[3]) : 0};
}

StoredBatch stored_batch(const std::filesystem::path& path, int number, std::uint64_t fingerprint) {
  std::variant<Batch, std::string> read = read_batch(path, fingerprint);
  if (auto* problem = std::get_if<std::string>(&read)) return {path, number, *problem, {}};
  return {path, number, "", std::get<Batch>(std::move(read))};
}

}  // namespace

std::string file_stem(const Shard& shard) { return fmt::format("{}-of-{}", shard.number, shard.count); }

std::string shard_text(const Shard& shard) { return fmt::format("{}/{}", shard.number, shard.count); }

std::uint64_t ShardState::data_end() const {
  std::uint64_t end = 0;
  for (const StoredBatch& batch : batches) end = std::max(end, batch.batch.data_end);
  return end;
}

std::uint64_t ShardState::tiles() const {
  std::uint64_t count = 0;
  for (const StoredBatch& batch : batches) count += batch.batch.tiles.size();
  return count;
}

bool RunFolder::is_one(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) && std::filesystem::exists(path / "manifest.json");
}

bool RunFolder::exists() const { return std::filesystem::is_directory(path_); }

std::filesystem::path RunFolder::file_of(const Shard& shard, const char* suffix) const {
  return path_ / fmt::format("{}.{}", file_stem(shard), suffix);
}

std::filesystem::path RunFolder::batch_of(const Shard& shard, int number) const {
  return path_ / fmt::format("{}.{:06}.batch", file_stem(shard), number);
}

std::vector<ShardState> RunFolder::shards(std::uint64_t fingerprint) const {
  std::map<std::pair<int, int>, ShardState> found;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    const std::optional<FileName> file = parsed(name);
    if (!file || name.ends_with(".tmp")) continue;
    ShardState& state = found[{file->shard.count, file->shard.number}];
    state.shard = file->shard;
    if (file->kind == "batch") state.batches.push_back(stored_batch(entry.path(), file->number, fingerprint));
    if (file->kind == "bad") ++state.batches_set_aside;
  }
  std::vector<ShardState> states;
  for (auto& [key, state] : found) {
    state.data = file_of(state.shard, "data");
    state.writer = RunLock::owner(file_of(state.shard, "lock"));
    std::sort(state.batches.begin(), state.batches.end(),
              [](const StoredBatch& a, const StoredBatch& b) { return a.number < b.number; });
    states.push_back(std::move(state));
  }
  return states;
}

void RunFolder::remove(const Shard& shard) const {
  std::vector<std::filesystem::path> batches, others;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    const std::optional<FileName> file = parsed(entry.path().filename().string());
    if (!file || file->shard != shard || file->kind == "lock") continue;
    (file->kind == "batch" ? batches : others).push_back(entry.path());
  }
  for (const auto& path : batches) disk::remove(path);  // first: what they say is no longer so
  for (const auto& path : others) disk::remove(path);
}

void RunFolder::remove_if_empty() const {
  const std::string manifest_name = manifest().filename().string();
  std::vector<std::filesystem::path> manifests;  // and what a killed process left of its writing
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    if (!entry.path().filename().string().starts_with(manifest_name)) return;
    manifests.push_back(entry.path());
  }
  for (const auto& path : manifests) disk::remove(path);
  disk::remove(path_);
}

Piece read_chunks(int descriptor, const std::filesystem::path& data, const TileRecord& tile) {
  const std::uint64_t size = stored_bytes(tile);
  Piece piece{page_memory(size), size, tile.stored_digest};
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        pread(descriptor, piece.memory.get() + done, size - done, static_cast<off_t>(tile.address + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) disk::failed(data, "read it");
    if (count == 0) throw IntegrityError(fmt::format("{}: it ends before tile {}", data.string(), tile.number));
    done += static_cast<std::size_t>(count);
  }
  if (digest_of(piece.bytes()) != tile.stored_digest)
    throw IntegrityError(fmt::format("{}: tile {} is not what was written", data.string(), tile.number));
  return piece;
}

std::string data_problem(const std::filesystem::path& data, const Batch& batch) {
  const int descriptor = open(data.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return fmt::format("{}: cannot open it: {}", data.string(), std::strerror(errno));
  std::string problem;
  try {
    for (const TileRecord& tile : batch.tiles) read_chunks(descriptor, data, tile);
  } catch (const std::runtime_error& error) {
    problem = error.what();
  }
  close(descriptor);
  return problem;
}

}  // namespace portrait
