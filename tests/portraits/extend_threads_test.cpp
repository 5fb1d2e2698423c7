// A sweep that takes a part of its settings from an earlier portrait: threads ask for settings and complete tiles at once.
#include "engine/sweep/method.h"
#include "grids/sweep_job.h"
#include "portraits/earlier_portrait.h"
#include "portraits/facts.h"
#include "portraits/writer.h"
#include "tests/portraits/dated_scratch.h"

namespace portrait {
namespace {

Grid grid_up_to(double delta, std::uint64_t deltas) {
  Grid grid;
  grid.family = {Plant::dipdt, 0, Prefilter::none};
  grid.horizon = Horizon::fixed(20);
  grid.measures = {Measure::IAE_w, Measure::Ms};
  grid.axes = {Axis::linear(Parameter::kappa, 0.05, 0.35, 61), Axis::linear(Parameter::delta, 0.4, delta, deltas)};
  grid.fixed = {{Parameter::tau_i, 8}};
  return grid;
}

class ExtendThreads : public DatedScratchTest {
 protected:
  const std::string method_ = method_text(Method::kernel);

  std::string bytes_of_sweep(const std::string& name, const Grid& grid, int threads,
                             EarlierPortrait* earlier = nullptr) const {
    PortraitWriter writer(in(name), grid, {.command_line = "", .method = method_}, Existing::replace);
    const Tiling tiling(grid);
    SweepJob job = sweep_job(grid, tiling, threads);
    if (earlier != nullptr)
      job.settings_of = [&](std::uint64_t tile) { return earlier->missing_in(tiling.box(tile)); };
    job.prepare = [&](std::uint64_t tile, const MeasureColumns& columns) -> StoreStep {
      const auto encoded = std::make_shared<EncodedTile>(
          writer.encode(tile, earlier == nullptr ? columns : earlier->completed(tiling.box(tile), columns)));
      return [&writer, encoded] { writer.write(std::move(*encoded)); };
    };
    EXPECT_TRUE(sweep(job).complete);
    writer.publish({.wall_seconds = 0, .threads = 1});
    return bytes_of(in(name));
  }
};

TEST_F(ExtendThreads, TheSameBytesAsAWholeSweepForAnyNumber) {
  // Most of it is there, so that threads meet while they complete tiles more than while they measure.
  const Grid before = grid_up_to(0.85, 901), now = grid_up_to(0.9, 1001);
  bytes_of_sweep("before.h5", before, 1);
  const std::string whole = bytes_of_sweep("now.h5", now, 1);
  for (const int threads : {2, 5}) {
    EarlierPortrait earlier(in("before.h5"), now, method_);
    EXPECT_EQ(earlier.reused(), setting_count(before));
    EXPECT_TRUE(bytes_of_sweep("now.h5", now, threads, &earlier) == whole) << threads;
  }
}

}  // namespace
}  // namespace portrait
