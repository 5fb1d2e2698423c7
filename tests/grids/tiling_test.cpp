#include "grids/tiling.h"

#include <numeric>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "engine/base/check.h"
#include "tests/grids/test_grids.h"

namespace portrait {
namespace {

using Extents = std::vector<std::uint64_t>;

std::uint64_t row_major(const Extents& at, const Extents& extent) {
  std::uint64_t number = 0;
  for (std::size_t k = 0; k < at.size(); ++k) number = number * extent[k] + at[k];
  return number;
}

/// Numbers of the settings of a box, the slow way: walk the grid and ask each whether it is inside.
Extents numbers_in(const Grid& grid, const Box& box) {
  Extents numbers;
  for (std::uint64_t number = 0; number < setting_count(grid); ++number) {
    const Extents at = coordinates(grid, number);
    bool inside = true;
    for (std::size_t k = 0; k < at.size(); ++k)
      inside = inside && box.start[k] <= at[k] && at[k] < box.start[k] + box.extent[k];
    if (inside) numbers.push_back(number);
  }
  return numbers;
}

bool same(const Setting& a, const Setting& b) {
  return a.kappa == b.kappa && a.tau_i == b.tau_i && a.delta == b.delta && a.tau_1 == b.tau_1 &&
         a.tau_f == b.tau_f && a.b == b.b && a.c == b.c;
}

TEST(Tiling, TrailingAxesStayWholeAndTheNextIsSplitEqually) {
  EXPECT_EQ(Tiling(grid_of({127, 15, 9})).tile_extent(), (Extents{26, 15, 9}));  // 30 fit: 5 pieces of 26
  EXPECT_EQ(Tiling(grid_of({10, 4096})).tile_extent(), (Extents{1, 4096}));
  EXPECT_EQ(Tiling(grid_of({10, 4097})).tile_extent(), (Extents{1, 2049}));  // not 4096 and 1
  EXPECT_EQ(Tiling(grid_of({5, 1, 4096})).tile_extent(), (Extents{1, 1, 4096}));
  EXPECT_EQ(Tiling(grid_of({8, 14, 12, 5})).tile_extent(), (Extents{4, 14, 12, 5}));  // 4 fit: 2 pieces of 4
  EXPECT_EQ(Tiling(grid_of({3, 2})).tile_extent(), (Extents{3, 2}));
}

TEST(Tiling, AGridWithoutAxesIsOneTileOfOneSetting) {
  const Grid grid = grid_of({});
  const Tiling tiling(grid);
  EXPECT_EQ(tiling.tile_count(), 1u);
  EXPECT_TRUE(tiling.tile_extent().empty());
  EXPECT_EQ(tiling.box(0).size(), 1u);
  EXPECT_EQ(settings_in(grid, tiling.box(0)).size(), 1u);
}

TEST(Tiling, TilesAtTheFarEdgeAreSmaller) {
  const Tiling tiling(grid_of({127, 15, 9}));
  EXPECT_EQ(tiling.tile_count(), 5u);
  EXPECT_EQ(tiling.box(3).start, (Extents{78, 0, 0}));
  EXPECT_EQ(tiling.box(3).extent, (Extents{26, 15, 9}));
  EXPECT_EQ(tiling.box(4).start, (Extents{104, 0, 0}));
  EXPECT_EQ(tiling.box(4).extent, (Extents{23, 15, 9}));
  EXPECT_THROW(tiling.box(5), BrokenPromise);
}

TEST(Tiling, AQuadrillionSettingsAreTiledAtOnce) {
  const Grid grid = grid_of({100'000, 100'000, 100'000});
  const Tiling tiling(grid);
  EXPECT_EQ(tiling.tile_extent(), (Extents{1, 1, 4000}));  // 25 pieces
  EXPECT_EQ(tiling.tile_count(), 250'000'000'000u);
  const Box last = tiling.box(tiling.tile_count() - 1);
  EXPECT_EQ(last.start, (Extents{99'999, 99'999, 24 * 4000}));
  EXPECT_EQ(settings_in(grid, last).back().tau_i, 100'000);
}

RC_GTEST_PROP(TilingProperty, EverySettingStandsInExactlyOneTileInRowMajorOrder, ()) {
  Extents sizes(*rc::gen::inRange<std::size_t>(0, 5));
  for (auto& size : sizes)
    size = *rc::gen::weightedOneOf<std::uint64_t>(
        {{4, rc::gen::inRange<std::uint64_t>(1, 9)}, {1, rc::gen::inRange<std::uint64_t>(1, 6000)}});
  const Grid grid = grid_of(sizes);
  RC_PRE(setting_count(grid) < 20'000u);
  const Tiling tiling(grid);
  std::vector<int> seen(setting_count(grid), 0);
  for (std::uint64_t tile = 0; tile < tiling.tile_count(); ++tile) {
    const Box box = tiling.box(tile);
    RC_ASSERT(0 < box.size() && box.size() <= kTileSettings);
    const Extents numbers = numbers_in(grid, box);
    const std::vector<Setting> settings = settings_in(grid, box);
    RC_ASSERT(numbers.size() == settings.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ++seen[numbers[i]];
      RC_ASSERT(same(settings[i], setting_at(grid, numbers[i])));
    }
  }
  RC_ASSERT(seen == std::vector<int>(seen.size(), 1));
}

TEST(Tiling, NumbersOfTilesAreRowMajorToo) {
  const Grid grid = grid_of({3, 40, 240});
  const Tiling tiling(grid);
  const Extents tiles_along = {3, 3, 1};  // 17 of 40 fit: 3 pieces of 14
  for (std::uint64_t tile = 0; tile < tiling.tile_count(); ++tile) {
    const Box box = tiling.box(tile);
    EXPECT_EQ(row_major({box.start[0], box.start[1] / 14, 0}, tiles_along), tile);
  }
}

}  // namespace
}  // namespace portrait
