#include "engine/sweep/tile_queue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/engine/sweep/numbered_tiles.h"

namespace portrait {
namespace {

using Numbers = std::vector<std::uint64_t>;

constexpr std::size_t kSlice = TileQueue::kSliceSettings;

std::vector<Slice> all_slices(TileQueue& queue) {
  std::vector<Slice> slices;
  std::optional<std::uint64_t> own;
  while (const auto slice = queue.next(own)) {
    slices.push_back(*slice);
    own = slice->tile->number;
  }
  return slices;
}

void measure_and_finish(TileQueue& queue, const Slice& slice) {
  NumberedTiles::measure(slice);
  queue.finish(slice);
}

Numbers first_numbers(std::size_t count) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(TileQueue, CutsTilesIntoSlicesInOrder) {
  NumberedTiles tiles({2 * kSlice + 6, 5, 2 * kSlice});
  TileQueue queue = tiles.queue();
  std::vector<std::array<std::size_t, 3>> cuts;
  for (const Slice& slice : all_slices(queue)) cuts.push_back({slice.tile->number, slice.first, slice.count});
  EXPECT_EQ(cuts, (std::vector<std::array<std::size_t, 3>>{{0, 0, kSlice},
                                                           {0, kSlice, kSlice},
                                                           {0, 2 * kSlice, 6},
                                                           {1, 0, 5},
                                                           {2, 0, kSlice},
                                                           {2, kSlice, kSlice}}));
  EXPECT_FALSE(queue.next());
}

TEST(TileQueue, AThreadStaysOnItsTileAndHelpsInTheEnd) {
  NumberedTiles tiles({2 * kSlice, 3 * kSlice, kSlice});
  TileQueue queue = tiles.queue();
  const auto tile_of = [](const std::optional<Slice>& slice) { return slice ? slice->tile->number : 99; };
  EXPECT_EQ(tile_of(queue.next()), 0u);
  EXPECT_EQ(tile_of(queue.next()), 1u) << "another thread begins another tile";
  EXPECT_EQ(tile_of(queue.next(0)), 0u);
  EXPECT_EQ(tile_of(queue.next(1)), 1u);
  EXPECT_EQ(tile_of(queue.next(0)), 2u) << "its own is given out";
  EXPECT_EQ(tile_of(queue.next(2)), 1u) << "none is left to begin";
  EXPECT_FALSE(queue.next(1));
}

TEST(TileQueue, MakesATileWhenItsFirstSliceIsWanted) {
  NumberedTiles tiles({kSlice + 1, 1});
  TileQueue queue = tiles.queue();
  EXPECT_EQ(tiles.made, Numbers{});
  queue.next();
  queue.next(0);
  EXPECT_EQ(tiles.made, Numbers{0});
  queue.next(0);
  EXPECT_EQ(tiles.made, (Numbers{0, 1}));
}

TEST(TileQueue, ATileStartsEmpty) {
  NumberedTiles tiles({2});
  TileQueue queue = tiles.queue();
  const auto slice = queue.next();
  EXPECT_EQ(slice->tile->columns.status, (std::vector{Status::not_computed, Status::not_computed}));
  EXPECT_TRUE(std::isnan(slice->tile->columns.values[0][0]));
}

TEST(TileQueue, StoresATileWhenItsLastSliceIsBack) {
  NumberedTiles tiles({kSlice + 8, 1});
  TileQueue queue = tiles.queue();
  const std::vector<Slice> slices = all_slices(queue);
  measure_and_finish(queue, slices[1]);
  EXPECT_EQ(tiles.stored, Numbers{});
  EXPECT_EQ(queue.settings_measured(), 8u);
  measure_and_finish(queue, slices[0]);
  EXPECT_EQ(tiles.stored, Numbers{0});
  EXPECT_EQ(queue.settings_measured(), kSlice + 8);
  EXPECT_EQ(queue.tiles_stored(), 1u);
}

TEST(TileQueue, ATileWaitsForThoseBeforeIt) {
  NumberedTiles tiles({1, 1, 1, 1});
  TileQueue queue = tiles.queue();
  const std::vector<Slice> slices = all_slices(queue);
  for (const std::size_t late : {2u, 1u}) measure_and_finish(queue, slices[late]);
  EXPECT_EQ(tiles.stored, Numbers{});
  measure_and_finish(queue, slices[0]);
  EXPECT_EQ(tiles.stored, (Numbers{0, 1, 2}));
  measure_and_finish(queue, slices[3]);
  EXPECT_EQ(tiles.stored, (Numbers{0, 1, 2, 3}));
}

TEST(TileQueue, StoresInOrderWhateverTheOrderOfTheSlices) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<std::size_t> sizes(1 + random() % 8);
    for (std::size_t& size : sizes) size = 1 + random() % (3 * kSlice);
    NumberedTiles tiles(sizes);
    TileQueue queue = tiles.queue();
    std::vector<Slice> slices = all_slices(queue);
    std::shuffle(slices.begin(), slices.end(), random);
    for (const Slice& slice : slices) measure_and_finish(queue, slice);
    ASSERT_EQ(tiles.stored, first_numbers(sizes.size()));
    ASSERT_EQ(queue.settings_measured(), std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}));
  }
}

TEST(TileQueue, AnEmptyTileIsStoredInItsTurn) {
  NumberedTiles tiles({0, 3, 0});
  TileQueue queue = tiles.queue();
  for (const Slice& slice : all_slices(queue)) measure_and_finish(queue, slice);
  EXPECT_EQ(tiles.stored, (Numbers{0, 1, 2}));
}

TEST(TileQueue, OfNoTilesHasNothingToDo) {
  NumberedTiles tiles({});
  TileQueue queue = tiles.queue();
  EXPECT_FALSE(queue.next());
  EXPECT_EQ(queue.tiles_stored(), 0u);
}

TEST(TileQueue, PreparesATileOutsideItsLockAndStoresItWithItsColumns) {
  std::vector<std::string> steps;
  std::unique_ptr<TileQueue> queue;
  queue = std::make_unique<TileQueue>(
      std::vector<Measure>{Measure::Ms}, 2, [](std::uint64_t) { return std::vector<Setting>(1); },
      [&](std::uint64_t tile, const MeasureColumns& columns) -> StoreStep {
        steps.push_back("prepare " + std::to_string(tile) + " of " + std::to_string(queue->settings_measured()));
        return [&, tile] {
          steps.push_back("store " + std::to_string(tile) + " " + std::to_string(columns.settings()));
        };
      });
  const std::vector<Slice> slices = all_slices(*queue);
  measure_and_finish(*queue, slices[1]);
  measure_and_finish(*queue, slices[0]);
  EXPECT_EQ(steps, (std::vector<std::string>{"prepare 1 of 1", "prepare 0 of 2", "store 0 1", "store 1 1"}));
}

TEST(TileQueue, GivesOutNothingMoreWhenClosed) {
  NumberedTiles tiles({kSlice + 8, 1});
  TileQueue queue = tiles.queue();
  const auto slice = queue.next();
  queue.close();
  EXPECT_FALSE(queue.next());
  measure_and_finish(queue, *slice);
  EXPECT_EQ(queue.settings_measured(), kSlice);
}

TEST(TileQueue, AStoreThatFailedIsNotCalledAgain) {
  int calls = 0;
  TileQueue queue(
      {}, 3, [](std::uint64_t) { return std::vector<Setting>(1); },
      [&](std::uint64_t, const MeasureColumns&) -> StoreStep {
        return [&] {
          ++calls;
          throw std::out_of_range("disk full");
        };
      });
  const std::vector<Slice> slices = all_slices(queue);
  EXPECT_THROW(queue.finish(slices[0]), std::out_of_range);
  EXPECT_NO_THROW(queue.finish(slices[1]));
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(queue.tiles_stored(), 0u);
}

}  // namespace
}  // namespace portrait
