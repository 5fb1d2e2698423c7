#include <algorithm>
#include <atomic>
#include <chrono>
#include <latch>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include "tests/engine/sweep/numbered_tiles.h"

namespace portrait {
namespace {

/// Storing is not guarded: that the queue does it by one thread at a time is part of the test, and the thread sanitizer
/// would see if it did not.
TEST(TileQueueThreads, StoreEveryTileOnceAndInOrder) {
  for (const int count : {2, 5}) {
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < 300; ++i) sizes.push_back(1 + i * 37 % 90);
    NumberedTiles tiles(sizes);
    TileQueue queue = tiles.queue();
    const auto work = [&] {
      std::optional<std::uint64_t> own;
      while (const auto slice = queue.next(own)) {
        own = slice->tile->number;
        NumberedTiles::measure(*slice);
        if (slice->first % 64 == 0) std::this_thread::yield();
        queue.finish(*slice);
      }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();

    ASSERT_EQ(tiles.stored.size(), sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) EXPECT_EQ(tiles.stored[i], i);
    std::sort(tiles.made.begin(), tiles.made.end());
    EXPECT_EQ(tiles.made, tiles.stored) << "once each";
    EXPECT_EQ(queue.tiles_stored(), sizes.size());
  }
}

TEST(TileQueueThreads, CanBeAskedForTheirProgressMeanwhile) {
  NumberedTiles tiles(std::vector<std::size_t>(100, 40));
  TileQueue queue = tiles.queue();
  std::atomic<bool> done = false;
  std::thread watcher([&] {
    std::uint64_t last = 0;
    while (!done) {
      const std::uint64_t measured = queue.settings_measured();
      EXPECT_GE(measured, last);
      EXPECT_LE(queue.tiles_stored(), 100u);
      last = measured;
    }
  });
  while (const auto slice = queue.next()) {
    NumberedTiles::measure(*slice);
    queue.finish(*slice);
  }
  done = true;
  watcher.join();
  EXPECT_EQ(queue.settings_measured(), 4000u);
}

TEST(TileQueueThreads, PrepareTilesBesideEachOther) {
  std::latch both(2);
  int stored = 0;
  TileQueue queue(
      {}, 2, [](std::uint64_t) { return std::vector<Setting>(1); },
      [&](std::uint64_t, const MeasureColumns&) -> StoreStep {
        both.arrive_and_wait();  // for ever, if one had to wait for the other
        return [&] { ++stored; };
      });
  const auto first = queue.next(), second = queue.next();
  std::thread other([&] { queue.finish(*first); });
  queue.finish(*second);
  other.join();
  EXPECT_EQ(stored, 2);
}

/// The first tile does not come back, so none is stored: another thread measures on alone until memory is full.
class FullQueue : public ::testing::Test {
 protected:
  void SetUp() override {
    while (begun_ < TileQueue::kTilesInMemory) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  static constexpr std::uint64_t kTiles = 3 * TileQueue::kTilesInMemory;
  std::atomic<std::uint64_t> begun_ = 0;
  std::uint64_t stored_ = 0;
  TileQueue queue_{{},
                   kTiles,
                   [this](std::uint64_t) {
                     ++begun_;
                     return std::vector<Setting>(1);
                   },
                   [this](std::uint64_t, const MeasureColumns&) -> StoreStep { return [this] { ++stored_; }; }};
  std::optional<Slice> held_ = queue_.next();
  std::thread other_{[this] {
    while (const auto slice = queue_.next()) queue_.finish(*slice);
  }};
};

TEST_F(FullQueue, WaitsUntilATileIsStored) {
  EXPECT_EQ(begun_, TileQueue::kTilesInMemory);
  queue_.finish(*held_);
  other_.join();
  EXPECT_EQ(begun_, kTiles);
  EXPECT_EQ(stored_, kTiles);
}

TEST_F(FullQueue, LetsGoWhenItIsClosed) {
  queue_.close();
  other_.join();
  EXPECT_EQ(begun_, TileQueue::kTilesInMemory);
  EXPECT_EQ(stored_, 0u);
}

}  // namespace
}  // namespace portrait
