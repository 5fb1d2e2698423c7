/// The order of work in a sweep, without threads of its own: tiles are cut into slices for the workers, and
/// finished tiles leave in the order of their numbers, one at a time.
///
/// Any number of threads may call `next` and `finish`. Only the tiles between the oldest not stored and the newest
/// begun are in memory, `kTilesInMemory` at most: who asks for more waits, so that measuring does not run away from
/// a slow disk. What is computed depends on the slice alone, and what is handed out on the tile numbers alone: the
/// result has the same bits for any number of threads.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/loop/loop.h"
#include "engine/measures/columns.h"

namespace portrait {

/// Stores a tile that was prepared for it.
using StoreStep = std::function<void()>;

/// A tile on its way from settings to measures.
struct Tile {
  std::uint64_t number = 0;
  std::vector<Setting> settings;
  MeasureColumns columns;
  std::size_t unfinished = 0;  ///< settings still to be measured
  StoreStep store;             ///< once all are
};

/// Settings [first, first + count) of a tile: what one worker measures at a time.
struct Slice {
  std::shared_ptr<Tile> tile;
  std::size_t first = 0;
  std::size_t count = 0;
};

class TileQueue {
 public:
  using SettingsOf = std::function<std::vector<Setting>(std::uint64_t tile)>;
  using Prepare = std::function<StoreStep(std::uint64_t tile, const MeasureColumns& columns)>;
  static constexpr std::uint64_t kTilesInMemory = 16;
  static constexpr std::size_t kSliceSettings = 128;

  /// `settings_of` is called by many threads at once, each with another tile.
  TileQueue(std::vector<Measure> measures, std::uint64_t tile_count, SettingsOf settings_of, Prepare prepare)
      : measures_(std::move(measures)),
        tile_count_(tile_count),
        settings_of_(std::move(settings_of)),
        prepare_(std::move(prepare)) {}

  /// The next slice to measure: of the tile `own` that this thread was on, while it lasts, then of a new one, whose
  /// memory stays with the thread's processor; of another thread's when no tile may be begun. Nothing when all are
  /// given out, or the queue is closed. Waits while too many tiles are in memory.
  /// REQUIRES: every other slice is being measured by another thread, or finished.
  std::optional<Slice> next(std::optional<std::uint64_t> own = std::nullopt);

  /// Takes a measured slice back. The last one of a tile prepares it, beside other threads; then every tile whose
  /// turn has come is stored, by one thread at a time.
  void finish(const Slice& slice);

  /// Begins no more tiles: those begun are given out to their ends, and stored.
  void begin_no_more();

  /// Gives out no more slices: a worker failed, and its slice will not come back.
  void close();

  std::uint64_t settings_measured() const;
  std::uint64_t tiles_stored() const;

 private:
  /// A tile that is being cut into slices.
  struct OpenTile {
    std::shared_ptr<Tile> tile;
    std::size_t cut = 0;  ///< settings given out
  };

  using OpenTiles = std::map<std::uint64_t, OpenTile>;

  bool may_begin() const;
  std::uint64_t begin_tile(std::unique_lock<std::mutex>& lock);
  Slice cut(OpenTiles::iterator from);
  void store_in_order(std::unique_lock<std::mutex>& lock);

  const std::vector<Measure> measures_;
  const std::uint64_t tile_count_;
  const SettingsOf settings_of_;
  const Prepare prepare_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;  ///< a tile was opened or stored, or the end is near
  OpenTiles open_;
  std::uint64_t begun_ = 0;     ///< tiles begun
  std::uint64_t coming_ = 0;    ///< tiles begun, but not open yet
  std::uint64_t stored_ = 0;    ///< tiles stored: all below this number
  std::uint64_t measured_ = 0;  ///< settings
  bool storing_ = false;        ///< one thread is in a store step
  bool closed_ = false;
  bool ending_ = false;  ///< no tile is begun any more
  std::map<std::uint64_t, std::shared_ptr<Tile>> waiting_;  ///< prepared, but an earlier tile is not stored
};

}  // namespace portrait
