// A run and a portrait beyond 4 GiB: tiles, the index of HDF5 and all else that lies behind them are found, checked and
// read there. The first 4 GiB are a hole, so that a few megabytes of the disk are enough; bench/merge_rate writes such a
// file in full.
#include <cmath>

#include <fcntl.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "grids/grid_file.h"
#include "portraits/merge.h"
#include "portraits/reader.h"
#include "portraits/run_writer.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

constexpr std::uint64_t k4GiB = std::uint64_t{1} << 32;
/// Whole pages, and no round number: an address cut to 32 bits would lie in the middle of the head.
constexpr std::uint64_t kHole = k4GiB + 3 * kPageBytes;

constexpr const char* kGridText =
    "plant = \"dipdt\"\nn = 0\nhorizon = 40\nmeasures = [\"IAE_w\", \"Ms\"]\n[parameters]\n"
    "kappa = { from = 0.08, to = 0.24, count = 12 }\ntau_i = { from = 8, to = 14, count = 2100 }\ndelta = 0.5\n";

class LargeFiles : public ScratchTest {
 protected:
  void SetUp() override {
    ScratchTest::SetUp();
    const std::uint64_t room = std::filesystem::space(parent()).available;
    if (room < 2 * kHole) GTEST_SKIP() << "the disk has " << room << " bytes left, too few if it knows no holes";
  }

  std::unique_ptr<RunWriter> begin() const {
    return std::make_unique<RunWriter>(in("p.h5"), grid_, provenance_, Shard{}, RunStart::resume);
  }
  void write(RunWriter& run, std::size_t tiles) const {
    for (std::size_t i = 0; i < tiles; ++i) {
      const std::uint64_t tile = run.tiles_to_do()[i];
      run.write(run.encode(tile, sample::columns(grid_, tile)));
    }
    run.commit();
  }
  RunFolder folder() const { return RunFolder::of_target(in("p.h5")); }
  ShardState shard() const { return folder().shards(fingerprint(manifest_of(grid_, provenance_))).front(); }

  static void put(const std::filesystem::path& path, std::span<const std::byte> bytes, std::uint64_t at) {
    const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    const ssize_t count = pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    close(file);
    ASSERT_EQ(count, static_cast<ssize_t>(bytes.size()));
  }

  /// As if 4 GiB had been written before the tiles that are stored.
  void move_behind_a_hole() const {
    const ShardState now = shard();
    Batch batch = now.batches.front().batch;
    const int file = open(now.data.c_str(), O_RDONLY | O_CLOEXEC);
    for (TileRecord& tile : batch.tiles) {
      const Piece chunks = read_chunks(file, now.data, tile);
      tile.address += kHole;
      put(now.data, chunks.bytes(), tile.address);
    }
    close(file);
    batch.data_end += kHole;
    std::filesystem::resize_file(now.data, batch.data_end);
    write_batch(now.batches.front().path, batch);
  }
  /// Four tiles behind the hole, then a new process for the rest.
  std::unique_ptr<RunWriter> all_tiles() const {
    write(*begin(), 4);
    move_behind_a_hole();
    std::unique_ptr<RunWriter> run = begin();
    EXPECT_TRUE(run->set_aside().empty());
    EXPECT_EQ(run->tiles_done(), 4u);
    write(*run, 8);
    return run;
  }

  static void flip_a_bit(const std::filesystem::path& path, std::uint64_t at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const int byte = file.seekg(static_cast<std::streamoff>(at)).get();
    file.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(byte ^ 16));
  }
  static std::string digests(const std::filesystem::path& path) {
    std::string all;
    for (const CheckedDataset& dataset : verify(path, 1).datasets) all += dataset.name + dataset.digest;
    return all;
  }
  std::string digests_of_a_small_file() const {
    sample::write(in("small.h5"), grid_, Existing::refuse);
    return digests(in("small.h5"));
  }
  void expect_values(const std::filesystem::path& path) const {
    const PortraitReader portrait(path);
    std::vector<double> values;
    for (const Measure measure : grid_.measures) {
      portrait.read(measure, 0, portrait.settings(), values);
      for (std::uint64_t i = 0; i < values.size(); ++i) {
        const double wanted = sample::value(measure, i);
        ASSERT_TRUE(values[i] == wanted || (std::isnan(values[i]) && std::isnan(wanted))) << i;
      }
    }
  }

  const Grid grid_ = parse_grid(kGridText, "test");
  const Provenance provenance_{"portrait sweep sample.toml", "sample", "2025-01-31T09:30:00Z"};
};

TEST_F(LargeFiles, a_portrait_whose_chunks_and_index_lie_beyond_4_GiB) {
  const std::string expected = digests_of_a_small_file();
  all_tiles()->finish({}, Existing::refuse);
  EXPECT_GT(std::filesystem::file_size(in("p.h5")), kHole);
  EXPECT_EQ(digests(in("p.h5")), expected);
  expect_values(in("p.h5"));
  flip_a_bit(in("p.h5"), DataFile::kHeadBytes + kHole + 5);
  EXPECT_NE(message_of<IntegrityError>([&] { verify(in("p.h5"), 1); }).find("IAE_w is damaged"), std::string::npos);
}

TEST_F(LargeFiles, damage_beyond_4_GiB_of_a_run_is_found_and_mended) {
  const std::string expected = digests_of_a_small_file();
  all_tiles().reset();
  const TileRecord last = shard().batches.back().batch.tiles.back();
  ASSERT_GT(last.address, k4GiB);
  flip_a_bit(shard().data, last.address + 3);
  EXPECT_NE(data_problem(shard().data, shard().batches.back().batch).find("tile 11 is not what was written"),
            std::string::npos);
  const auto run = begin();
  EXPECT_EQ(run->set_aside().size(), 1u);
  write(*run, 8);
  run->finish({}, Existing::refuse);
  EXPECT_EQ(digests(in("p.h5")), expected);
}

TEST_F(LargeFiles, shards_beyond_4_GiB_are_merged) {
  const std::string expected = digests_of_a_small_file();
  all_tiles().reset();
  EXPECT_EQ(merge_runs({folder()}, in("m.h5"), Existing::refuse, {}, "").tiles, 12u);
  EXPECT_EQ(digests(in("m.h5")), expected);
  expect_values(in("m.h5"));
}

}  // namespace
}  // namespace portrait
