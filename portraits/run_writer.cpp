#include "portraits/run_writer.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fmt/format.h>
#include <sys/stat.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/disk.h"
#include "portraits/finished_portrait.h"
#include "portraits/merge.h"
#include "portraits/writer.h"

namespace portrait {
namespace {

Provenance dated(Provenance provenance) {
  if (provenance.date.empty()) provenance.date = date_text();
  return provenance;
}

bool by_number(const TileRecord& a, const TileRecord& b) { return a.number < b.number; }

}  // namespace

RunWriter::RunWriter(const std::filesystem::path& target, const Grid& grid, const Provenance& provenance,
                     const Shard& shard, RunStart start, BatchLimits limits)
    : target_(target),
      folder_(RunFolder::of_target(target)),
      grid_(grid),
      rows_(grid),
      provenance_(dated(provenance)),
      shard_(shard),
      limits_(limits),
      fingerprint_(fingerprint(manifest_of(grid, provenance_))),
      done_(rows_.tile_count()) {
  PORTRAIT_CHECK(1 <= shard.number && shard.number <= shard.count);
  begin_folder(manifest_of(grid, provenance_), start);
  take_over(start);
  for (std::uint64_t tile = 0; tile < rows_.tile_count(); ++tile)
    if (shard_.has(tile) && !done_[tile]) to_do_.push_back(tile);
}

/// A run that left no batch leaves nothing. What cannot be removed now is in nobody's way.
RunWriter::~RunWriter() {
  data_.reset();
  if (finished_ || last_batch_ > 0) return;
  try {
    if (lock_) folder_.remove(shard_);
    lock_.reset();
    if (shard_.count == 1 && folder_.exists()) folder_.remove_if_empty();  // other shards may be about to begin
  } catch (const std::exception&) {
  }
}

// ---------------------------------------------------------------- beginning

void RunWriter::begin_folder(const RunManifest& manifest, RunStart start) {
  if (!disk::may("mkdir") || (mkdir(folder_.path().c_str(), 0777) != 0 && errno != EEXIST))
    disk::failed(folder_.path(), "create the folder");
  lock_ = std::make_unique<RunLock>(folder_.file_of(shard_, "lock"));
  if (start == RunStart::replace)
    for (const ShardState& shard : folder_.shards(fingerprint_))
      if (shard.shard == shard_ || (shard_.count == 1 && !shard.writer)) folder_.remove(shard.shard);
  keep_manifest(manifest);
}

/// The first of several shards writes it; the others must be of the same run.
void RunWriter::keep_manifest(const RunManifest& manifest) {
  if (!std::filesystem::exists(folder_.manifest()) && disk::write_new_file(folder_.manifest(), json_text(manifest)))
    return;
  const RunManifest kept = read_manifest(folder_.manifest());
  const std::string differs = difference(kept, manifest);
  if (differs.empty()) return;
  for (const ShardState& shard : folder_.shards(fingerprint(kept)))
    if (!shard.batches.empty() || (shard.writer && shard.shard != shard_))
      throw InputError(fmt::format("{} is of another run (--force throws it away):{}", folder_.path().string(), differs));
  disk::write_whole_file(folder_.manifest(), json_text(manifest));
}

void RunWriter::take_over(RunStart start) {
  others_ = folder_.shards(fingerprint_);
  for (ShardState& shard : others_) {
    if (shard_.count == 1 && shard.shard != shard_ && shard.writer)
      throw InputError(fmt::format("{}: shard {} is being written by {}", folder_.path().string(),
                                   shard_text(shard.shard), *shard.writer));
    if (shard.shard == shard_)
      for (const StoredBatch& batch : shard.batches) last_batch_ = std::max(last_batch_, batch.number);
    // Another shard that is being written is its writer's to check; its tiles are no business of this one.
    if (shard.shard != shard_ && shard.writer) continue;
    for (StoredBatch& batch : shard.batches) take_batch(shard, batch);
  }
  if (start == RunStart::fresh && last_batch_ > 0)
    throw InputError(fmt::format(
        "{} holds {} of {} tiles of a sweep that was stopped (--resume goes on with it, --force begins anew)",
        folder_.path().string(), done_count_, rows_.tile_count()));
  std::uint64_t end = 0;
  for (const ShardState& shard : others_)
    if (shard.shard == shard_) end = shard.data_end();
  const std::filesystem::path data = folder_.file_of(shard_, "data");
  if (end == 0 && std::filesystem::exists(data)) disk::remove(data);
  data_ = end == 0 ? DataFile::create(data) : DataFile::reopen(data, end);
  pending_from_ = data_->end();
}

void RunWriter::take_batch(const ShardState& shard, const StoredBatch& batch) {
  const std::string problem = batch.problem.empty() ? data_problem(shard.data, batch.batch) : batch.problem;
  if (!problem.empty()) {
    set_aside_.push_back(fmt::format("{}: {}", batch.path.string(), problem));
    disk::rename(batch.path, std::filesystem::path(batch.path).replace_extension("bad"));
    return;
  }
  for (const TileRecord& tile : batch.batch.tiles) {
    if (tile.number >= rows_.tile_count() || done_[tile.number]) continue;
    done_[tile.number] = true;
    ++done_count_;
    if (shard.shard == shard_) own_.push_back(tile);
  }
}

// ---------------------------------------------------------------- writing

EncodedTile RunWriter::encode(std::uint64_t tile, const MeasureColumns& columns) const {
  return encode_tile(grid_, rows_, tile, columns);
}

void RunWriter::write(EncodedTile tile) {
  const std::uint64_t number = tile.record.number;
  PORTRAIT_CHECK(next_ < to_do_.size() && to_do_[next_] == number);
  pending_.push_back(append_tile(*data_, std::move(tile)));
  ++next_;
  done_[number] = true;
  ++done_count_;
  if (commit_is_due()) commit();
}

bool RunWriter::commit_is_due() const {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - last_commit_;
  return data_->end() - pending_from_ >= limits_.bytes || since.count() >= limits_.seconds;
}

void RunWriter::commit() {
  last_commit_ = std::chrono::steady_clock::now();
  if (pending_.empty()) return;
  if (!lasting_) disk::sync_directory(disk::directory_of(folder_.path()));
  lasting_ = true;
  const std::uint64_t end = data_->commit();
  write_batch(folder_.batch_of(shard_, last_batch_ + 1), {fingerprint_, end, pending_});
  ++last_batch_;
  pending_from_ = end;
  own_.insert(own_.end(), pending_.begin(), pending_.end());
  pending_.clear();
}

// ---------------------------------------------------------------- the end

void RunWriter::finish(const RunFacts& facts, Existing existing) {
  PORTRAIT_CHECK(grid_is_complete());
  if (last_batch_ > 0) commit();  // a run as long as this is not to be lost now
  try {
    make_portrait(facts, existing);
  } catch (...) {
    if (!pending_.empty() && data_) commit();
    throw;
  }
  finished_ = true;
  for (const ShardState& shard : folder_.shards(fingerprint_)) folder_.remove(shard.shard);
  lock_.reset();
  for (const ShardState& shard : folder_.shards(fingerprint_)) disk::remove(folder_.file_of(shard.shard, "lock"));
  folder_.remove_if_empty();
}

/// All tiles in one data file: it becomes the portrait as it is. In several: their chunks are copied together.
void RunWriter::make_portrait(const RunFacts& facts, Existing existing) {
  std::vector<TileRecord> tiles = own_;
  tiles.insert(tiles.end(), pending_.begin(), pending_.end());
  std::sort(tiles.begin(), tiles.end(), by_number);
  if (tiles.size() != rows_.tile_count()) {
    commit();
    merge_runs({folder_}, target_, existing, facts, provenance_.command_line);
    return;
  }
  const std::filesystem::path data = folder_.file_of(shard_, "data");
  const std::uint64_t end = data_->commit();
  finish_portrait(data, end, grid_, provenance_, facts, tiles);
  give_name(data, target_, existing);
  data_.reset();
}

}  // namespace portrait
