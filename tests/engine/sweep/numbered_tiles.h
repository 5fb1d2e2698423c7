/// Tiles of given sizes whose settings carry their own numbers, and the queue's store that checks them.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "engine/sweep/tile_queue.h"

namespace portrait {

class NumberedTiles {
 public:
  explicit NumberedTiles(std::vector<std::size_t> sizes) : sizes_(std::move(sizes)) {}

  TileQueue queue() {
    return TileQueue(
        {Measure::Ms}, sizes_.size(), [this](std::uint64_t tile) { return make(tile); },
        [this](std::uint64_t tile, const MeasureColumns& columns) -> StoreStep {
          return [this, tile, &columns] { store(tile, columns); };
        });
  }

  /// Writes into a slice what `store` expects: the number of the tile and of the setting.
  static void measure(const Slice& slice) {
    for (std::size_t i = slice.first; i < slice.first + slice.count; ++i) {
      MeasureRow row;
      row[Measure::Ms] = slice.tile->settings[i].kappa;
      slice.tile->columns.set(i, Status::settled, row);
    }
  }

  std::vector<std::uint64_t> made;    ///< tiles, in the order of the calls, which many threads make
  std::vector<std::uint64_t> stored;  ///< likewise, by one thread at a time

 private:
  std::vector<Setting> make(std::uint64_t tile) {
    {
      const std::scoped_lock lock(mutex_);
      made.push_back(tile);
    }
    std::vector<Setting> settings(sizes_[tile]);
    for (std::size_t i = 0; i < settings.size(); ++i) settings[i].kappa = number(tile, i);
    return settings;
  }

  void store(std::uint64_t tile, const MeasureColumns& columns) {
    stored.push_back(tile);
    ASSERT_EQ(columns.kept, std::vector<Measure>{Measure::Ms});
    ASSERT_EQ(columns.settings(), sizes_[tile]);
    for (std::size_t i = 0; i < columns.settings(); ++i) {
      EXPECT_EQ(columns.status[i], Status::settled);
      EXPECT_EQ(columns.values[0][i], number(tile, i));
    }
  }

  static double number(std::uint64_t tile, std::size_t i) { return static_cast<double>(1'000'000 * tile + i); }

  std::vector<std::size_t> sizes_;
  std::mutex mutex_;
};

}  // namespace portrait
