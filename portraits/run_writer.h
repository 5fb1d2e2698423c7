/// Writes a sweep so that nothing is lost: into a run folder, batch by batch, until the portrait can be made.
///
///     RunWriter run(path, grid, provenance, shard, RunStart::resume);
///     for tile in run.tiles_to_do(): run.write(run.encode(tile, columns));
///     run.commit();                                   when stopping
///     run.finish({wall_seconds, threads}, existing);  when the whole grid is there
///
/// A batch is brought to the disk after 256 MB or a minute: that much is lost at most, whatever happens. A sweep shorter
/// than that costs no more than a writer without a folder. Resuming reads every batch and every chunk of it; what is
/// damaged is set aside and its tiles are to do again.
///
/// result    the same values, digests and chunks as an uninterrupted run: tests/portraits/run_kill_test.cpp
/// errors    InputError: another run's folder, another writer, a stopped run that is not to be resumed. StoreError: disk
/// cost      memory: a record per tile, and some tiles (portraits/data_file.h)
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/data_file.h"
#include "portraits/encoded_tile.h"
#include "portraits/facts.h"
#include "portraits/run_folder.h"
#include "portraits/run_lock.h"
#include "portraits/temporary_file.h"

namespace portrait {

enum class RunStart {
  fresh,    ///< refuse when a stopped run is there
  resume,   ///< go on with it, or begin
  replace,  ///< throw it away
};

struct BatchLimits {
  std::uint64_t bytes = std::uint64_t{256} << 20;
  double seconds = 60;
};

class RunWriter {
 public:
  RunWriter(const std::filesystem::path& target, const Grid& grid, const Provenance& provenance, const Shard& shard,
            RunStart start, BatchLimits limits = {});
  ~RunWriter();

  const RunFolder& folder() const { return folder_; }
  /// What was damaged, a line each: these tiles are to do again.
  const std::vector<std::string>& set_aside() const { return set_aside_; }
  /// Of this shard, that no valid batch has, in order.
  const std::vector<std::uint64_t>& tiles_to_do() const { return to_do_; }
  std::uint64_t tiles_done() const { return done_count_; }  ///< of the whole grid

  /// Any number of threads may encode while another writes.
  EncodedTile encode(std::uint64_t tile, const MeasureColumns& columns) const;
  /// REQUIRES: the next tile to do.
  void write(EncodedTile tile);
  /// Brings everything written so far to the disk.
  void commit();

  /// Whether every tile of the grid is there, whoever computed it.
  bool grid_is_complete() const { return done_count_ == rows_.tile_count(); }
  /// Makes the portrait and removes the folder. REQUIRES: grid_is_complete(); called once.
  void finish(const RunFacts& facts, Existing existing);

 private:
  void begin_folder(const RunManifest& manifest, RunStart start);
  void keep_manifest(const RunManifest& manifest);
  void take_over(RunStart start);
  void take_batch(const ShardState& shard, const StoredBatch& batch);
  bool commit_is_due() const;
  void make_portrait(const RunFacts& facts, Existing existing);

  std::filesystem::path target_;
  RunFolder folder_;
  Grid grid_;
  TileRows rows_;
  Provenance provenance_;
  Shard shard_;
  BatchLimits limits_;
  std::uint64_t fingerprint_;
  std::unique_ptr<RunLock> lock_;
  std::unique_ptr<DataFile> data_;
  std::vector<std::string> set_aside_;
  std::vector<std::uint64_t> to_do_;
  std::size_t next_ = 0;  ///< of to_do_
  std::vector<bool> done_;
  std::uint64_t done_count_ = 0;
  std::vector<ShardState> others_;   ///< all that left batches, this one too, as they were found
  std::vector<TileRecord> own_;      ///< of tiles in this shard's data file
  std::vector<TileRecord> pending_;  ///< written, in no batch yet
  int last_batch_ = 0;
  bool lasting_ = false;  ///< the folder itself is on the disk
  bool finished_ = false;
  std::uint64_t pending_from_ = 0;
  std::chrono::steady_clock::time_point last_commit_ = std::chrono::steady_clock::now();
};

}  // namespace portrait
