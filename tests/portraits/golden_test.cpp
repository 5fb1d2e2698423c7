// Portraits written by earlier programs, one of every format: read value by value, or refused with a sentence.
#include <string>

#include "engine/base/error.h"
#include "portraits/reader.h"
#include "portraits/schema.h"
#include "portraits/verify.h"
#include "tests/portraits/content.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

std::filesystem::path golden(const std::string& version) {
  return std::filesystem::path(PORTRAIT_SOURCE_DIR) / "tests/golden" / ("portrait-" + version + ".h5");
}

class ReadGolden : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Formats, ReadGolden, ::testing::Values("2.0.0", "2.1.0", "2.2.0"));

TEST_P(ReadGolden, ValueByValue) {
  PortraitReader portrait(golden(GetParam()));
  const Grid grid = sample::small_grid();
  EXPECT_EQ(portrait.grid().measures, grid.measures);
  EXPECT_EQ(portrait.grid().family.plant, grid.family.plant);
  EXPECT_EQ(portrait.grid().horizon.dead_times, grid.horizon.dead_times);
  ASSERT_EQ(portrait.grid().axes.size(), grid.axes.size());
  for (std::size_t i = 0; i < grid.axes.size(); ++i) EXPECT_EQ(portrait.grid().axes[i].values(), grid.axes[i].values());
  ASSERT_EQ(portrait.settings(), setting_count(grid));
  const std::vector<Status> statuses = statuses_of(portrait, 0, portrait.settings());
  for (const Measure measure : grid.measures) {
    const std::vector<double> values = values_of(portrait, measure, 0, portrait.settings());
    for (std::uint64_t i = 0; i < values.size(); ++i) {
      EXPECT_EQ(statuses[i], sample::status(i));
      EXPECT_EQ(raw(std::vector{values[i]}), raw(std::vector{sample::value(measure, i)})) << to_string(measure) << " of " << i;
    }
  }
}

TEST_P(ReadGolden, IsWhole) { EXPECT_NO_THROW(verify(golden(GetParam()))); }

TEST(Golden, EarlierFormatsAreRefusedByName) {
  for (const std::string version : {"1.0.0", "1.1.0", "1.2.0"})
    EXPECT_EQ(message_of<InputError>([&] { PortraitReader portrait(golden(version)); }),
              golden(version).string() + ": this portrait has format " + version + "; this program reads format 2.x");
}

TEST(Golden, ThereIsOneOfThePresentFormat) { EXPECT_TRUE(std::filesystem::exists(golden(schema::kVersion))) << schema::kVersion; }

}  // namespace
}  // namespace portrait
