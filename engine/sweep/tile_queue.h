/// The order of work in a sweep, without threads of its own: tiles are cut into slices for the workers, and
/// finished tiles leave in the order of their numbers, one at a time.
///
/// Any number of threads may call `next` and `finish`. Only the tiles between the oldest unfinished and the
/// newest begun are in memory. What is computed depends on the slice alone, and what is handed out on the
/// tile numbers alone: the result has the same bits for any number of threads.
#pragma once

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

/// A tile on its way from settings to measures.
struct Tile {
  std::uint64_t number = 0;
  std::vector<Setting> settings;
  MeasureColumns columns;
  std::size_t unfinished = 0;  ///< settings still to be measured
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
  using Store = std::function<void(std::uint64_t tile, const MeasureColumns& columns)>;

  TileQueue(std::vector<Measure> measures, std::uint64_t tile_count, SettingsOf settings_of, Store store)
      : measures_(std::move(measures)),
        tile_count_(tile_count),
        settings_of_(std::move(settings_of)),
        store_(std::move(store)) {}

  /// The next slice to measure; nothing when all are given out.
  std::optional<Slice> next();

  /// Takes a measured slice back, and stores every tile whose turn has come.
  void finish(const Slice& slice);

  std::uint64_t settings_measured() const;
  std::uint64_t tiles_stored() const;

 private:
  void store_in_order(std::unique_lock<std::mutex>& lock);

  static constexpr std::size_t kSliceSettings = 128;

  const std::vector<Measure> measures_;
  const std::uint64_t tile_count_;
  const SettingsOf settings_of_;
  const Store store_;

  mutable std::mutex mutex_;
  std::shared_ptr<Tile> current_;                           ///< being cut into slices
  std::size_t cut_ = 0;                                     ///< settings of `current_` given out
  std::uint64_t begun_ = 0;                                 ///< tiles begun
  std::uint64_t stored_ = 0;                                ///< tiles stored: all below this number
  std::uint64_t measured_ = 0;                              ///< settings
  bool storing_ = false;                                    ///< one thread is in `store_`
  std::map<std::uint64_t, std::shared_ptr<Tile>> waiting_;  ///< measured, but an earlier tile is not
};

}  // namespace portrait
