// What a run folder notices: damage, another run, another writer; and that shards make the portrait of the whole.
#include <random>

#include "engine/base/error.h"
#include "grids/grid_file.h"
#include "portraits/merge.h"
#include "portraits/run_writer.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

constexpr const char* kGridText =
    "plant = \"dipdt\"\nn = 0\nhorizon = 40\nmeasures = [\"IAE_w\", \"Ms\"]\n[parameters]\n"
    "kappa = { from = 0.08, to = 0.24, count = 12 }\ntau_i = { from = 8, to = 14, count = 2100 }\ndelta = 0.5\n";

class RunFolders : public ScratchTest {
 protected:
  const Grid grid_ = parse_grid(kGridText, "test");
  const Provenance provenance_{"portrait sweep sample.toml", "sample", "2025-01-31T09:30:00Z"};
  const BatchLimits limits_{.bytes = 70'000, .seconds = 1e9};

  std::unique_ptr<RunWriter> begin(RunStart start = RunStart::resume, const Shard& shard = {}) const {
    return std::make_unique<RunWriter>(in("p.h5"), grid_, provenance_, shard, start, limits_);
  }
  void write(RunWriter& run, std::size_t tiles) const {
    for (std::size_t i = 0; i < tiles && i < run.tiles_to_do().size(); ++i) {
      const std::uint64_t tile = run.tiles_to_do()[i];
      run.write(run.encode(tile, sample::columns(grid_, tile)));
    }
    run.commit();
  }
  std::string digests(const char* name) const {
    std::string all;
    for (const CheckedDataset& dataset : verify(in(name), 1).datasets) all += dataset.name + dataset.digest;
    return all;
  }
  std::string whole() const {
    sample::write(in("whole.h5"), grid_, Existing::replace);
    return digests("whole.h5");
  }
  RunFolder folder() const { return RunFolder::of_target(in("p.h5")); }
  std::vector<ShardState> shards() const { return folder().shards(fingerprint(manifest_of(grid_, provenance_))); }

  /// Whether anything is wrong with the first shard, its data included.
  bool is_damaged() const {
    const ShardState shard = shards().front();
    for (const StoredBatch& batch : shard.batches)
      if (!batch.problem.empty() || !data_problem(shard.data, batch.batch).empty()) return true;
    return false;
  }
};

TEST_F(RunFolders, every_flipped_bit_is_found) {
  write(*begin(), 6);
  const ShardState shard = shards().front();
  ASSERT_EQ(shard.batches.size(), 3u);
  ASSERT_FALSE(is_damaged());
  std::vector<std::pair<std::filesystem::path, std::pair<std::uint64_t, std::uint64_t>>> places;
  for (const StoredBatch& batch : shard.batches) {
    places.push_back({batch.path, {0, std::filesystem::file_size(batch.path)}});
    for (const TileRecord& tile : batch.batch.tiles) places.push_back({shard.data, {tile.address, stored_bytes(tile)}});
  }
  std::mt19937_64 random(1);
  int found = 0;
  for (int flip = 0; flip < 1000; ++flip) {
    const auto& [path, range] = places[random() % places.size()];
    const auto at = static_cast<std::streamoff>(range.first + random() % range.second);
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const int byte = file.seekg(at).get();
    const auto put = [&](int value) { file.seekp(at).put(static_cast<char>(value)).flush(); };
    put(byte ^ 1 << random() % 8);
    found += is_damaged() ? 1 : 0;
    put(byte);
  }
  EXPECT_EQ(found, 1000);
  EXPECT_FALSE(is_damaged());
}

TEST_F(RunFolders, damaged_batches_are_set_aside_and_computed_again) {
  const std::string expected = whole();
  write(*begin(), 8);
  const ShardState shard = shards().front();
  put_bytes(shard.batches[1].path, bytes_of(shard.batches[1].path).substr(0, 40));  // one cut short
  std::filesystem::resize_file(shard.data, shard.batches[3].batch.tiles[0].address + 10);
  auto run = begin();
  EXPECT_EQ(run->set_aside().size(), 2u);
  EXPECT_EQ(run->tiles_done(), 4u);
  write(*run, 100);
  run->finish({}, Existing::refuse);
  run.reset();
  EXPECT_EQ(digests("p.h5"), expected);
  EXPECT_FALSE(folder().exists());
}

TEST_F(RunFolders, one_writer_at_a_time) {
  const auto first = begin();
  const std::string message = message_of<InputError>([&] { begin(); });
  EXPECT_NE(message.find("is being written by process " + std::to_string(getpid())), std::string::npos) << message;
}

TEST_F(RunFolders, a_stopped_run_is_not_thrown_away_unasked) {
  write(*begin(), 4);
  EXPECT_NE(message_of<InputError>([&] { begin(RunStart::fresh); }).find("holds 4 of 12 tiles"), std::string::npos);
  EXPECT_EQ(begin()->tiles_done(), 4u);
  EXPECT_EQ(begin(RunStart::replace)->tiles_done(), 0u);
  EXPECT_FALSE(folder().exists());
}

TEST_F(RunFolders, another_grid_or_method_is_refused_with_what_differs) {
  write(*begin(), 4);
  const Grid other = parse_grid(std::string(kGridText).replace(std::string(kGridText).find("0.24"), 4, "0.25"), "test");
  const std::string message =
      message_of<InputError>([&] { RunWriter(in("p.h5"), other, provenance_, {}, RunStart::resume); });
  EXPECT_NE(message.find("the grid: line 6: \"kappa = { from = 0.08, to = 0.24, count = 12 }\", now"), std::string::npos)
      << message;
  const std::string method = message_of<InputError>(
      [&] { RunWriter(in("p.h5"), grid_, {"", "kernel, base", ""}, {}, RunStart::resume); });
  EXPECT_NE(method.find("the method: sample, now kernel, base"), std::string::npos) << method;
}

TEST_F(RunFolders, another_version_is_refused_with_what_differs) {
  write(*begin(), 4);
  const RunManifest now = manifest_of(grid_, provenance_);
  RunManifest earlier = now;
  earlier.program = "portrait 0.0.1";
  earlier.schema_version = "1.0.0";
  put_bytes(folder().manifest(), json_text(earlier));
  EXPECT_EQ(message_of<InputError>([&] { begin(); }),
            folder().path().string() + " is of another run (--force throws it away):\n  the format: 1.0.0, now " +
                now.schema_version + "\n  the program: portrait 0.0.1, now " + now.program);
}

TEST_F(RunFolders, shards_make_the_portrait_of_the_whole) {
  const std::string expected = whole();
  for (const int number : {3, 1}) write(*begin(RunStart::resume, {number, 3}), 100);
  EXPECT_EQ(message_of<InputError>([&] { merge_runs({folder()}, in("p.h5"), Existing::refuse, {}, ""); }),
            "4 of 12 tiles are missing: run shard 2/3 again with --resume");
  write(*begin(RunStart::resume, {2, 3}), 2);  // killed
  write(*begin(RunStart::resume, {2, 3}), 100);
  EXPECT_EQ(merge_runs({folder()}, in("p.h5"), Existing::refuse, {}, "").duplicates, 0u);
  EXPECT_EQ(digests("p.h5"), expected);
}

TEST_F(RunFolders, one_process_may_finish_what_shards_began) {
  const std::string expected = whole();
  write(*begin(RunStart::resume, {2, 3}), 100);
  write(*begin(RunStart::resume, {1, 3}), 2);
  auto run = begin();
  EXPECT_EQ(run->tiles_done(), 6u);
  write(*run, 100);
  run->finish({}, Existing::refuse);
  run.reset();
  EXPECT_EQ(digests("p.h5"), expected);
  EXPECT_FALSE(folder().exists());
}

TEST_F(RunFolders, duplicates_must_be_equal) {
  write(*begin(RunStart::resume, {1, 2}), 2);
  {
    auto run = RunWriter(in("q.h5"), grid_, provenance_, {}, RunStart::resume, limits_);
    for (const std::uint64_t tile : run.tiles_to_do()) {
      MeasureColumns columns = sample::columns(grid_, tile);
      if (tile == 2) columns.values[0][0] += 0.5;
      run.write(run.encode(tile, columns));
    }
    run.commit();
  }
  EXPECT_NE(message_of<IntegrityError>([&] {
              merge_runs({folder(), RunFolder::of_target(in("q.h5"))}, in("m.h5"), Existing::refuse, {}, "");
            }).find("tile 2 differs between"),
            std::string::npos);
}

}  // namespace
}  // namespace portrait
