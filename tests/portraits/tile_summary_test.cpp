#include "portraits/tile_summary.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "portraits/reader.h"
#include "tests/portraits/content.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Real>
TileRange range_of_values(const std::vector<Real>& values) {
  return range_of(std::as_bytes(std::span(values)), sizeof(Real));
}

/// One value after the other.
template <typename Real>
void expect_plain_range(const std::vector<Real>& values) {
  TileRange plain{kInfinity, -kInfinity, 0};
  for (const Real value : values) {
    if (value < plain.least) plain.least = static_cast<double>(value);
    if (value > plain.greatest) plain.greatest = static_cast<double>(value);
    if (std::isnan(value)) ++plain.missing;
  }
  const TileRange range = range_of_values(values);
  EXPECT_EQ(range.least, plain.least);
  EXPECT_EQ(range.greatest, plain.greatest);
  EXPECT_EQ(range.missing, plain.missing);
}

TEST(TileSummary, of_any_number_of_values) {
  std::mt19937 random(7);
  for (const std::size_t count : {0, 1, 7, 8, 9, 64, 1000}) {
    std::vector<double> values(count);
    std::vector<float> single(count);
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = random() % 5 == 0 ? kNan : std::normal_distribution<>()(random);
      single[i] = static_cast<float>(values[i]);
    }
    expect_plain_range(values);
    expect_plain_range(single);
  }
}

TEST(TileSummary, of_infinite_and_missing_values) {
  const TileRange range = range_of_values<double>({kNan, kInfinity, 2, kNan});
  EXPECT_EQ(range.least, 2);
  EXPECT_EQ(range.greatest, kInfinity);
  EXPECT_EQ(range.missing, 2u);
  const TileRange none = range_of_values<double>({kNan, kNan});
  EXPECT_EQ(none.least, kInfinity);
  EXPECT_EQ(none.greatest, -kInfinity);
}

class TileSummaryFile : public ScratchTest {};

TEST_F(TileSummaryFile, knows_the_ranges_of_what_it_stores) {
  for (const Precision precision : {Precision::real64, Precision::real32}) {
    const Grid grid = sample::grid_of({9, 7, 11, 13}, precision);
    sample::write(in("sample.h5"), grid, Existing::replace);
    const PortraitReader portrait(in("sample.h5"));
    const TileRows rows(grid);
    ASSERT_GT(rows.tile_count(), 2u);
    for (const Measure measure : grid.measures) {
      const std::vector<TileRange> ranges = portrait.tile_ranges(measure);
      ASSERT_EQ(ranges.size(), rows.tile_count());
      for (std::uint64_t tile = 0; tile < rows.tile_count(); ++tile) {
        const auto values = values_of(portrait, measure, rows.range(tile).first, rows.range(tile).count);
        const TileRange plain = range_of_values(values);
        EXPECT_EQ(ranges[tile].least, plain.least);
        EXPECT_EQ(ranges[tile].greatest, plain.greatest);
        EXPECT_EQ(ranges[tile].missing, plain.missing);
      }
    }
    std::uint64_t counted = 0;
    for (const StatusCounts& counts : portrait.tile_status_counts())
      counted += counts[static_cast<std::size_t>(Status::unstable)];
    std::uint64_t unstable = 0;
    for (const Status status : statuses_of(portrait, 0, portrait.settings()))
      unstable += status == Status::unstable;
    EXPECT_EQ(counted, unstable);
    EXPECT_GT(unstable, 0u);
  }
}

}  // namespace
}  // namespace portrait
