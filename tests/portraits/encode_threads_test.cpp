// A portrait has the same bytes whatever threads encode its tiles.
#include "engine/sweep/sweep.h"
#include "portraits/writer.h"
#include "tests/portraits/dated_scratch.h"
#include "tests/portraits/sample.h"

namespace portrait {
namespace {

class EncodeThreads : public DatedScratchTest {
 protected:
  /// Settings are measured for nothing: what is stored is the sample's.
  std::string bytes_with(int threads, const Grid& grid) const {
    const auto path = in("p.h5");
    PortraitWriter writer(path, grid, {.command_line = "", .method = ""}, Existing::replace);
    SweepJob job;
    job.tile_count = Tiling(grid).tile_count();
    job.settings_of = [](std::uint64_t) { return std::vector<Setting>(); };
    job.prepare = [&](std::uint64_t tile, const MeasureColumns&) -> StoreStep {
      const auto encoded =
          std::make_shared<EncodedTile>(writer.encode(tile, sample::repeating_columns(grid, tile)));
      return [&writer, encoded] { writer.write(std::move(*encoded)); };
    };
    job.threads = threads;
    EXPECT_TRUE(sweep(job).complete);
    writer.publish({.wall_seconds = 0, .threads = 1});
    return bytes_of(path);
  }
};

TEST_F(EncodeThreads, TheSameBytesForAnyNumber) {
  for (const Precision precision : {Precision::real64, Precision::real32}) {
    const Grid grid = sample::grid_of({40, 1400}, precision);
    const std::string alone = bytes_with(1, grid);
    for (const int threads : {2, 5}) EXPECT_EQ(bytes_with(threads, grid), alone) << threads;
  }
}

}  // namespace
}  // namespace portrait
