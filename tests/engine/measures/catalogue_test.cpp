#include "engine/measures/catalogue.h"

#include <cmath>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

namespace portrait {
namespace {

/// Names that users, scripts and stored portraits rely on: none may change or leave.
constexpr std::string_view kPublicNames[] = {
    "IAE_w",    "IAE_d",    "TV_yw",      "TV_uw",  "TV_yd",  "TV_ud",  "TV0_yw", "TV1_yw", "TV2_yw",  "TV0_uw",
    "TV1_uw",   "TV2_uw",   "TV0_yd",     "TV1_yd", "TV2_yd", "TV0_ud", "TV1_ud", "TV2_ud", "y_max_w", "u_max_w",
    "y_max_d",  "u_max_d",  "Ms",         "Mt",     "ISE_w",  "ISE_d",  "ITAE_w", "ITAE_d", "ITSE_w",  "ITSE_d",
    "Ms_omega", "Mt_omega", "noise_gain", "GM",     "GM_low", "PM",     "DM",
};

TEST(Catalogue, HoldsThePublicNames) {
  for (const auto name : kPublicNames) EXPECT_TRUE(measure_named(name)) << name;
}

TEST(Catalogue, NamesAreUniqueAndLeadBack) {
  std::set<std::string_view> seen;
  for (const Measure m : all_measures()) {
    EXPECT_TRUE(seen.insert(to_string(m)).second) << to_string(m);
    EXPECT_EQ(measure_named(to_string(m)), m);
  }
  EXPECT_EQ(seen.size(), kMeasureCount);
}

TEST(Catalogue, KnowsNoOtherName) {
  for (const char* name : {"", "iae_w", "IAE", "TV9_uw", "IAE_w "}) EXPECT_FALSE(measure_named(name)) << name;
}

TEST(Catalogue, EveryMeasureIsExplained) {
  for (const Measure m : all_measures()) {
    EXPECT_FALSE(info(m).long_name.empty());
    EXPECT_FALSE(info(m).definition.empty());
  }
}

/// _w, _d and _o, with y or u before it: GM_low ends in w and is of no step.
TEST(Catalogue, TheStepIsTheNamesLastLetter) {
  for (const Measure m : all_measures()) {
    const std::string_view name = to_string(m);
    const std::size_t dash = name.rfind('_');
    const bool of_a_step = dash != std::string_view::npos &&
                           (name.back() == 'w' || name.back() == 'd' || name.back() == 'o') &&
                           name.size() - dash <= 3;
    EXPECT_EQ(info(m).step, of_a_step ? name.back() : '-') << name;
  }
}

TEST(Catalogue, TheUnitIsThatOfTheSignal) {
  const auto unit = [](std::string_view name) { return info(*measure_named(name)).unit; };
  for (const char* name : {"IAE_w", "IAE_d"}) EXPECT_EQ(unit(name), Unit::output_time) << name;
  for (const char* name : {"TV_yw", "TV2_yd", "y_max_w", "y_max_d"}) EXPECT_EQ(unit(name), Unit::output) << name;
  for (const char* name : {"TV_uw", "TV2_ud", "u_max_w", "u_max_d"}) EXPECT_EQ(unit(name), Unit::input) << name;
  for (const char* name : {"ISE_w", "ISE_d"}) EXPECT_EQ(unit(name), Unit::output2_time) << name;
  for (const char* name : {"ITAE_w", "ITAE_d"}) EXPECT_EQ(unit(name), Unit::output_time2) << name;
  for (const char* name : {"ITSE_w", "ITSE_d"}) EXPECT_EQ(unit(name), Unit::output2_time2) << name;
  for (const char* name : {"Ms_omega", "Mt_omega"}) EXPECT_EQ(unit(name), Unit::per_time) << name;
  EXPECT_EQ(unit("PM"), Unit::degree);
  EXPECT_EQ(unit("DM"), Unit::time);
  EXPECT_EQ(unit("noise_gain"), Unit::input_per_output);
  for (const char* name : {"Ms", "Mt", "GM", "GM_low"}) EXPECT_EQ(unit(name), Unit::one) << name;
}

static_assert(all_measures().back() == Measure::expected_sigma_ratio);
static_assert(standard_measures().back() == Measure::noise_gain);
static_assert(noisy_measures().front() == Measure::noisy_TV_yw);

/// The first 37 are the standard ones; the last 35, from noisy_TV_yw on, are those that noise is drawn for.
TEST(Catalogue, TheStandardMeasuresComeFirstAndThoseUnderNoiseLast) {
  std::size_t i = 0;
  for (const Measure m : all_measures()) {
    EXPECT_EQ(static_cast<std::size_t>(m), i);
    EXPECT_EQ(is_standard(m), i < 37) << to_string(m);
    if (i < 37) {
      EXPECT_EQ(standard_measures()[i], m);
    }
    const std::string_view name = to_string(m);
    const bool noisy = name.starts_with("noisy_") || name.starts_with("spread_") || name.ends_with("sigma_ratio");
    EXPECT_EQ(is_noisy(m), noisy) << name;
    EXPECT_EQ(noisy, i >= 93) << name;
    if (noisy) {
      EXPECT_EQ(noisy_measures()[i - 93], m);
    }
    ++i;
  }
  EXPECT_EQ(i, 128U);
  EXPECT_EQ(standard_measures().back(), Measure::noise_gain);
  EXPECT_EQ(noisy_measures().size(), 35U);
}

TEST(MeasureRow, HoldsEveryMeasureInAPlaceOfItsOwn) {
  MeasureRow row;
  for (const Measure m : all_measures()) row[m] = static_cast<double>(static_cast<int>(m));
  const MeasureRow copy = row;
  for (const Measure m : all_measures()) EXPECT_EQ(copy[m], static_cast<double>(static_cast<int>(m)));
  row.clear();
  for (const Measure m : all_measures()) EXPECT_TRUE(std::isnan(row[m]));
}

TEST(MeasureRow, AFurtherMeasureLeavesTheOthersNaN) {
  for (const Measure one : {Measure::TV3_yw, Measure::expected_sigma_ratio}) {
    MeasureRow row;
    row[one] = 2;
    const MeasureRow& read = row;
    for (const Measure m : all_measures()) EXPECT_EQ(std::isnan(read[m]), m != one) << to_string(m);
  }
}

TEST(MeasureRow, StartsAsNaN) {
  MeasureRow row;
  for (const Measure m : all_measures()) EXPECT_TRUE(std::isnan(row[m]));
  row[Measure::Ms] = 1.5;
  EXPECT_EQ(row[Measure::Ms], 1.5);
  EXPECT_TRUE(std::isnan(row[Measure::Mt]));
}

}  // namespace
}  // namespace portrait
