/// The folder NAME.h5.run in which a sweep works until NAME.h5 is whole. One folder may hold several shards of one
/// grid, each written by a process of its own, on this machine or another:
///
///     manifest.json         what the run is of (portraits/run_manifest.h)
///     3-of-16.data          chunks of shard 3, appended (portraits/data_file.h); becomes the portrait when it has all
///     3-of-16.000001.batch  tiles of it that are on the disk for good (portraits/batch.h)
///     3-of-16.lock          held while a process writes the shard; says who
///     *.bad                 a batch that was damaged, set aside
///
/// The set of valid batches is the truth; everything else can be made again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "portraits/batch.h"
#include "portraits/data_file.h"
#include "portraits/run_manifest.h"

namespace portrait {

/// Part `number` of `count`, from 1 on: the tiles t with t % count == number - 1.
struct Shard {
  int number = 1;
  int count = 1;
  bool has(std::uint64_t tile) const {
    return tile % static_cast<std::uint64_t>(count) == static_cast<std::uint64_t>(number - 1);
  }
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// "3-of-16" as in file names; "3/16" as on the command line.
std::string file_stem(const Shard& shard);
std::string shard_text(const Shard& shard);

/// A batch as found in a folder.
struct StoredBatch {
  std::filesystem::path path;
  int number = 0;
  std::string problem;  ///< empty: `batch` is what was written
  Batch batch;
};

struct ShardState {
  Shard shard;
  std::filesystem::path data;
  std::vector<StoredBatch> batches;   ///< by number
  std::optional<std::string> writer;  ///< who is writing it now
  int batches_set_aside = 0;

  std::uint64_t data_end() const;    ///< of all valid batches
  std::uint64_t tiles() const;       ///< in valid batches
};

class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}
  /// "huba.h5" to "huba.h5.run".
  static RunFolder of_target(const std::filesystem::path& target) { return RunFolder(target.string() + ".run"); }
  /// Whether a path is such a folder.
  static bool is_one(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  bool exists() const;
  std::filesystem::path manifest() const { return path_ / "manifest.json"; }
  std::filesystem::path file_of(const Shard& shard, const char* suffix) const;
  std::filesystem::path batch_of(const Shard& shard, int number) const;

  /// Every shard that left a file, with its batches. Of the batches only the files are looked at, not the data.
  std::vector<ShardState> shards(std::uint64_t fingerprint) const;

  /// Removes the shard's files; and the folder, when nothing else is in it.
  void remove(const Shard& shard) const;
  void remove_if_empty() const;

 private:
  std::filesystem::path path_;
};

/// Reads the chunks of every tile and holds them against their digest; gives back what is wrong, empty: nothing.
/// cost      memory: the chunks of one tile. Time: bench/store_rate.cpp
std::string data_problem(const std::filesystem::path& data, const Batch& batch);

/// The chunks of a tile, as they are stored. Throws StoreError; IntegrityError when they are not what was written.
Piece read_chunks(int descriptor, const std::filesystem::path& data, const TileRecord& tile);

}  // namespace portrait
