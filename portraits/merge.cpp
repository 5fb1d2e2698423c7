#include "portraits/merge.h"

#include <map>
#include <memory>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "grids/grid_file.h"
#include "portraits/data_file.h"
#include "portraits/disk.h"
#include "portraits/finished_portrait.h"

namespace portrait {
namespace {

/// A data file open for reading.
class Source {
 public:
  explicit Source(std::filesystem::path path) : path_(std::move(path)) {
    descriptor_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) disk::failed(path_, "open it");
  }
  ~Source() { close(descriptor_); }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  Piece chunks(const TileRecord& tile) const { return read_chunks(descriptor_, path_, tile); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

struct Found {
  TileRecord record;
  const Source* source;
};

class Merge {
 public:
  explicit Merge(const std::vector<RunFolder>& folders) {
    for (const RunFolder& folder : folders) take(folder);
  }

  const RunManifest& manifest() const { return *manifest_; }
  MergeReport& report() { return report_; }

  /// REQUIRES: nothing; tells whoever owes tiles.
  void check_complete() const {
    if (tiles_.size() == manifest_->tiles) return;
    std::set<std::string> owing;
    for (std::uint64_t tile = 0; tile < manifest_->tiles; ++tile)
      if (!tiles_.contains(tile)) owing.insert(shard_text({static_cast<int>(tile % shard_count_) + 1, static_cast<int>(shard_count_)}));
    throw InputError(fmt::format("{} of {} tiles are missing: run shard {} again with --resume",
                                 manifest_->tiles - tiles_.size(), manifest_->tiles, fmt::join(owing, ", ")));
  }

  /// In order, each held against its digest.
  std::vector<TileRecord> copy_to(DataFile& file) {
    std::vector<TileRecord> records;
    for (auto& [number, found] : tiles_) {
      Piece chunks = found.source->chunks(found.record);
      found.record.address = file.end();
      report_.bytes += chunks.size;
      file.append(std::move(chunks));
      records.push_back(std::move(found.record));
    }
    return records;
  }

 private:
  void take(const RunFolder& folder) {
    if (!RunFolder::is_one(folder.path()))
      throw InputError(fmt::format("{}: this is no run folder of a sweep", folder.path().string()));
    const RunManifest manifest = read_manifest(folder.manifest());
    if (!manifest_) manifest_ = std::make_unique<RunManifest>(manifest);
    const std::string differs = difference(*manifest_, manifest);
    if (!differs.empty())
      throw InputError(fmt::format("{} is of another run:{}", folder.path().string(), differs));
    for (const ShardState& shard : folder.shards(fingerprint(manifest))) take(shard);
  }

  void take(const ShardState& shard) {
    shard_count_ = std::max<std::uint64_t>(shard_count_, static_cast<std::uint64_t>(shard.shard.count));
    if (shard.batches.empty()) return;
    ++report_.shards;
    sources_.push_back(std::make_unique<Source>(shard.data));
    for (const StoredBatch& batch : shard.batches) {
      if (!batch.problem.empty())
        throw IntegrityError(fmt::format("{}: {}: run shard {} again with --resume", batch.path.string(), batch.problem,
                                         shard_text(shard.shard)));
      for (const TileRecord& tile : batch.batch.tiles) take(tile, *sources_.back());
    }
  }

  void take(const TileRecord& tile, const Source& source) {
    const auto [at, is_new] = tiles_.try_emplace(tile.number, Found{tile, &source});
    if (is_new) return;
    ++report_.duplicates;
    if (at->second.record.stored_digest != tile.stored_digest || at->second.record.chunks != tile.chunks)
      throw IntegrityError(fmt::format("tile {} differs between {} and {}", tile.number,
                                       at->second.source->path().string(), source.path().string()));
  }

  std::unique_ptr<RunManifest> manifest_;
  std::uint64_t shard_count_ = 1;
  std::vector<std::unique_ptr<Source>> sources_;
  std::map<std::uint64_t, Found> tiles_;
  MergeReport report_;
};

}  // namespace

MergeReport merge_runs(const std::vector<RunFolder>& folders, const std::filesystem::path& target, Existing existing,
                       const RunFacts& facts, const std::string& command_line) {
  check_target(target, existing);
  Merge merge(folders);
  merge.check_complete();
  const RunManifest& manifest = merge.manifest();
  const Grid grid = parse_grid(manifest.grid_text, "the grid of the run");
  TemporaryFile temporary(target);
  std::unique_ptr<DataFile> file = DataFile::create(temporary.path());
  const std::vector<TileRecord> tiles = merge.copy_to(*file);
  const std::uint64_t end = file->commit();
  file.reset();
  finish_portrait(temporary.path(), end, grid, {command_line, manifest.method, manifest.date}, facts, tiles);
  temporary.publish(existing);
  merge.report().settings = manifest.settings;
  merge.report().tiles = tiles.size();
  return merge.report();
}

}  // namespace portrait
