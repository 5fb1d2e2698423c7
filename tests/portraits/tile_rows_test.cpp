// Tiles follow each other without gaps, and every setting is found in its tile.
#include "portraits/tile_rows.h"

#include <gtest/gtest.h>

#include "tests/portraits/sample.h"

namespace portrait {
namespace {

TEST(TileRows, TilesCoverAllSettingsInOrder) {
  for (const auto& sizes : std::vector<std::vector<std::uint64_t>>{
           {}, {1}, {1024}, {1025}, {3, 1000, 1}, {2, 1, 3000}, {5, 3, 4, 6}, {9, 11, 3, 70}}) {
    const Grid grid = sample::grid_of(sizes);
    const TileRows rows(grid);
    std::uint64_t next = 0;
    for (std::uint64_t tile = 0; tile < rows.tile_count(); ++tile) {
      const SettingRange range = rows.range(tile);
      EXPECT_EQ(range.first, next);
      EXPECT_EQ(rows.tile_of(range.first), tile);
      EXPECT_EQ(rows.tile_of(range.end() - 1), tile);
      next = range.end();
    }
    EXPECT_EQ(next, setting_count(grid));
  }
}

}  // namespace
}  // namespace portrait
