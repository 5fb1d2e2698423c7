// What is written comes back, bit for bit, for every shape of grid.
#include <bit>
#include <cmath>
#include <map>
#include <random>

#include "portraits/reader.h"
#include "portraits/tile_rows.h"
#include "portraits/verify.h"
#include "tests/portraits/content.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

class RoundTrip : public ScratchTest {};

std::vector<double> expected_values(Measure measure, std::uint64_t first, std::uint64_t count,
                                    Precision precision) {
  std::vector<double> values(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const double value = sample::value(measure, first + i);
    values[i] = precision == Precision::real64 ? value : static_cast<double>(static_cast<float>(value));
  }
  return values;
}

void expect_sample_values(PortraitReader& portrait, std::uint64_t first, std::uint64_t count) {
  for (const Measure measure : portrait.grid().measures)
    EXPECT_EQ(raw(values_of(portrait, measure, first, count)),
              raw(expected_values(measure, first, count, portrait.grid().precision)))
        << to_string(measure) << " from " << first << ", " << count << " settings";
  const std::vector<Status> statuses = statuses_of(portrait, first, count);
  for (std::uint64_t i = 0; i < count; ++i) EXPECT_EQ(statuses[i], sample::status(first + i));
}

std::map<std::string, std::string> digests(const std::filesystem::path& path) {
  std::map<std::string, std::string> found;
  for (const CheckedDataset& dataset : verify(path).datasets) found[dataset.name] = dataset.digest;
  return found;
}

// 1 x 5 and 5 x 1 have axes of one value; 2 x 1031 has rows longer than a tile, the last tile shorter than the
// rest.
const std::vector<std::vector<std::uint64_t>> kShapes = {
    {},        {1},       {5},         {2500},      {3, 4},       {1, 5},        {5, 1},
    {2, 1031}, {37, 100}, {7, 11, 13}, {3, 2, 700}, {5, 3, 4, 6}, {11, 3, 7, 29}};

TEST_F(RoundTrip, EveryShapeInBothPrecisions) {
  for (const Precision precision : {Precision::real64, Precision::real32})
    for (const auto& shape : kShapes) {
      const Grid grid = sample::grid_of(shape, precision);
      sample::write(in("p.h5"), grid, Existing::replace);
      PortraitReader portrait(in("p.h5"));
      EXPECT_EQ(portrait.settings(), setting_count(grid));
      EXPECT_EQ(grid_content(portrait.grid()), grid_content(grid));
      EXPECT_EQ(portrait.grid().precision, precision);
      expect_sample_values(portrait, 0, portrait.settings());
    }
}

TEST_F(RoundTrip, AnyRangeOfSettings) {
  const Grid grid = sample::grid_of({7, 11, 130});
  sample::write(in("p.h5"), grid);
  PortraitReader portrait(in("p.h5"));
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::uint64_t first = random() % (portrait.settings() + 1);
    expect_sample_values(portrait, first, random() % (portrait.settings() - first + 1));
  }
}

TEST_F(RoundTrip, InfinityOnAnAxis) {
  sample::write(in("p.h5"), sample::small_grid());
  const PortraitReader portrait(in("p.h5"));
  EXPECT_EQ(portrait.grid().axes[1].values(), (std::vector<double>{6, 8, 10, kInf}));
  EXPECT_EQ(portrait.setting(7).tau_i, kInf);
  EXPECT_EQ(portrait.setting(7).kappa, 0.24);
  EXPECT_EQ(portrait.setting(7).b, 0.5);
}

TEST_F(RoundTrip, HorizonUntilSettled) {
  Grid grid = sample::small_grid();
  grid.horizon = Horizon::until_settled();
  sample::write(in("p.h5"), grid);
  EXPECT_TRUE(PortraitReader(in("p.h5")).grid().horizon.automatic);
}

TEST_F(RoundTrip, Sampling) {
  Grid grid = sample::small_grid();
  sample::write(in("without.h5"), grid);
  EXPECT_FALSE(PortraitReader(in("without.h5")).grid().sampling);
  grid.sampling = 0.1;
  grid.measures.push_back(Measure::noise_gain);
  sample::write(in("p.h5"), grid);
  EXPECT_EQ(PortraitReader(in("p.h5")).grid().sampling, 0.1);
}

TEST_F(RoundTrip, LongGridFileAndEmptyTitle) {
  Grid grid = sample::small_grid();
  grid.title.clear();
  grid.text = std::string(300'000, '#') + "\n# \xce\xba\n";
  sample::write(in("p.h5"), grid);
  const PortraitReader portrait(in("p.h5"));
  EXPECT_EQ(portrait.grid().text, grid.text);
  EXPECT_EQ(portrait.grid().title, "");
}

TEST_F(RoundTrip, StatusAloneWhenNoMeasureIsKept) {
  Grid grid = sample::small_grid();
  grid.measures.clear();
  sample::write(in("p.h5"), grid);
  PortraitReader portrait(in("p.h5"));
  EXPECT_FALSE(portrait.has(Measure::Ms));
  EXPECT_EQ(statuses_of(portrait, 5, 1).front(), Status::unstable);
}

TEST_F(RoundTrip, EveryNanIsStoredAsTheSameNan) {
  const Grid grid = sample::grid_of({2});
  MeasureColumns columns = sample::columns(grid, 0);
  columns.values[0] = {-kNaN, std::bit_cast<double>(0x7ff8dead0000beefULL)};
  PortraitWriter writer(in("p.h5"), grid, {.command_line = "", .method = ""});
  writer.write(writer.encode(0, columns));
  writer.publish({});
  EXPECT_EQ(raw(values_of(PortraitReader(in("p.h5")), Measure::IAE_w, 0, 2)), raw(std::vector{kNaN, kNaN}));
}

TEST_F(RoundTrip, RepeatingValuesInBothPrecisions) {
  for (const Precision precision : {Precision::real64, Precision::real32}) {
    const Grid grid = sample::grid_of({5, 1000}, precision);
    sample::write(in("p.h5"), grid, Existing::replace, sample::repeating_columns);
    const PortraitReader portrait(in("p.h5"));
    std::vector<double> expected(portrait.settings());
    for (std::uint64_t i = 0; i < expected.size(); ++i) {
      const double value = sample::repeating_value(Measure::Ms, i);
      expected[i] = precision == Precision::real64 ? value : static_cast<double>(static_cast<float>(value));
    }
    EXPECT_EQ(raw(values_of(portrait, Measure::Ms, 0, portrait.settings())), raw(expected));
  }
}

TEST_F(RoundTrip, WritingWhatWasReadGivesTheSamePortrait) {
  sample::write(in("first.h5"), sample::grid_of({37, 100}, Precision::real32));
  PortraitReader first(in("first.h5"));
  const Grid& grid = first.grid();
  PortraitWriter writer(in("second.h5"), grid, {.command_line = "", .method = ""});
  for (std::uint64_t tile = 0; tile < Tiling(grid).tile_count(); ++tile) {
    const SettingRange range = TileRows(grid).range(tile);
    MeasureColumns columns(grid.measures, range.count);
    for (std::size_t k = 0; k < grid.measures.size(); ++k)
      columns.values[k] = values_of(first, grid.measures[k], range.first, range.count);
    columns.status = statuses_of(first, range.first, range.count);
    writer.write(writer.encode(tile, columns));
  }
  writer.publish({});
  EXPECT_EQ(digests(in("first.h5")), digests(in("second.h5")));
}

TEST_F(RoundTrip, FactsOfTheRun) {
  sample::write(in("p.h5"), sample::small_grid());
  const Facts facts = PortraitReader(in("p.h5")).facts();
  EXPECT_EQ(facts.history, facts.date_created + " portrait sweep sample.toml");
  EXPECT_EQ(facts.method, "sample");
  EXPECT_EQ(facts.state, "complete");
  EXPECT_EQ(facts.schema_version, "2.2.0");
  EXPECT_EQ(facts.wall_seconds, 1.5);
  EXPECT_EQ(facts.threads, 2);
}

}  // namespace
}  // namespace portrait
