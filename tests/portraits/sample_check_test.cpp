// A portrait whose digests are right and whose numbers are not is found out by its sample.
#include "portraits/sample_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/sweep/method.h"
#include "grids/grid_file.h"
#include "grids/sweep_job.h"
#include "portraits/reader.h"
#include "portraits/verify.h"
#include "portraits/writer.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

class SampleCheck : public ScratchTest {
 protected:
  /// 60 settings, stable and not, with every measure.
  Grid grid_ = parse_grid(
      "plant = \"dipdt\"\nn = 1\nhorizon = 30\nsampling = 0.1\n[parameters]\n"
      "kappa = { from = 0.1, to = 0.4, count = 5 }\ndelta = [0.4, 0.6, 0.8]\ntau_i = [8, 14, inf]\ntau_f = 0.1\n",
      "test");

  using Change = std::function<void(MeasureColumns&)>;

  /// What a sweep writes, changed before it is encoded: the digests are those of the changed values.
  void write(const Change& change = [](MeasureColumns&) {}) {
    const auto settings = settings_in(grid_, Tiling(grid_).box(0));
    std::vector<SettingMeasured> measured(settings.size());
    measure_settings(Method::kernel, grid_.family, grid_.horizon, extras_for(grid_), settings, measured);
    MeasureColumns columns(grid_.measures, settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) columns.set(i, measured[i].status, measured[i].measures);
    change(columns);
    PortraitWriter writer(in("p.h5"), grid_, {"portrait sweep test.toml", "test"}, Existing::replace);
    writer.write(writer.encode(0, columns));
    writer.publish({});
    EXPECT_NO_THROW(verify(in("p.h5"))) << "the digests are right";
  }

  SampleReport checked(std::uint64_t settings = 1000, std::uint64_t seed = 1) const {
    return check_sample(PortraitReader(in("p.h5")), {.settings = settings, .seed = seed});
  }

  /// The first setting with this status.
  static std::size_t first(const MeasureColumns& columns, Status status) {
    return static_cast<std::size_t>(std::find(columns.status.begin(), columns.status.end(), status) - columns.status.begin());
  }
  static double& at(MeasureColumns& columns, Measure m, std::size_t setting) {
    const auto k = std::find(columns.kept.begin(), columns.kept.end(), m) - columns.kept.begin();
    return columns.values[static_cast<std::size_t>(k)].at(setting);
  }
  static const MeasureCheck& of(const SampleReport& report, Measure m) {
    return *std::find_if(report.measures.begin(), report.measures.end(), [&](const MeasureCheck& c) { return c.measure == m; });
  }
};

TEST_F(SampleCheck, WhatASweepWroteIsRight) {
  write();
  const SampleReport report = checked();
  EXPECT_EQ(report.settings, 45u);
  EXPECT_EQ(report.failed, 0u);
  EXPECT_EQ(report.measures.size(), grid_.measures.size());
  for (const MeasureCheck& check : report.measures) EXPECT_LE(check.worst, check.allowed) << to_string(check.measure);
  EXPECT_GT(of(report, Measure::IAE_w).worst, 0) << "another method, other last digits";
}

/// One value of each measure, each in a setting of its own as long as there are some: named, with its setting.
TEST_F(SampleCheck, EveryChangedValueIsFound) {
  std::vector<std::size_t> settled, changed;
  write([&](MeasureColumns& columns) {
    for (std::size_t i = 0; i < columns.settings(); ++i)
      if (columns.status[i] == Status::settled) settled.push_back(i);
    for (std::size_t k = 0; k < columns.kept.size(); ++k) {
      changed.push_back(settled[k % settled.size()]);
      double& value = columns.values[k][changed[k]];
      value = std::isfinite(value) ? value * 1.01 + 0.001 : 1;
    }
  });
  const SampleReport report = checked();
  EXPECT_GT(settled.size(), 5u);
  EXPECT_EQ(report.failed, std::min(settled.size(), grid_.measures.size()));
  for (std::size_t k = 0; k < changed.size(); ++k) {
    EXPECT_EQ(report.measures[k].failed, 1u) << to_string(report.measures[k].measure);
    EXPECT_EQ(report.measures[k].where, changed[k]) << to_string(report.measures[k].measure);
  }
}

TEST_F(SampleCheck, ASmallChangeIsFoundToo) {
  write([&](MeasureColumns& columns) { at(columns, Measure::IAE_w, first(columns, Status::settled)) *= 1 + 3e-8; });
  EXPECT_EQ(checked().failed, 1u);
  write([&](MeasureColumns& columns) { at(columns, Measure::Ms, first(columns, Status::settled)) *= 1 - 3e-8; });
  EXPECT_EQ(checked().failed, 1u);
}

TEST_F(SampleCheck, AStatusAndAMissingValueAreFound) {
  write([](MeasureColumns& columns) { columns.status[first(columns, Status::unstable)] = Status::settled; });
  const SampleReport report = checked();
  EXPECT_EQ(report.failed, 1u);
  ASSERT_EQ(report.statuses.size(), 1u);
  EXPECT_EQ(report.statuses[0].truth, Status::unstable);
  write([&](MeasureColumns& columns) { at(columns, Measure::DM, first(columns, Status::settled)) = kNaN; });
  EXPECT_TRUE(std::isinf(of(checked(), Measure::DM).worst));
  write([&](MeasureColumns& columns) { at(columns, Measure::DM, first(columns, Status::unstable)) = 1; });
  EXPECT_EQ(of(checked(), Measure::DM).failed, 1u);
}

TEST_F(SampleCheck, SinglePrecisionIsRightWithinItsRounding) {
  grid_.precision = Precision::real32;
  write();
  EXPECT_EQ(checked().failed, 0u);
  EXPECT_GT(of(checked(), Measure::IAE_w).worst, 1e-9);
  write([&](MeasureColumns& columns) { at(columns, Measure::IAE_w, first(columns, Status::settled)) *= 1 + 4e-7; });
  EXPECT_EQ(checked().failed, 1u);
}

TEST_F(SampleCheck, ASampleIsThatOfItsSeed) {
  EXPECT_EQ(random_settings(1'000'000'000'000, 50, 7), random_settings(1'000'000'000'000, 50, 7));
  EXPECT_NE(random_settings(1'000'000'000'000, 50, 7), random_settings(1'000'000'000'000, 50, 8));
  EXPECT_EQ(random_settings(3, 10, 1), (std::vector<std::uint64_t>{0, 1, 2}));
  // Each number as often as any other, within five standard deviations.
  std::vector<int> seen(20);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const auto numbers = random_settings(20, 5, seed);
    EXPECT_EQ(std::set<std::uint64_t>(numbers.begin(), numbers.end()).size(), 5u);
    for (const std::uint64_t number : numbers) ++seen[number];
  }
  for (const int count : seen) EXPECT_NEAR(count, 1000, 5 * std::sqrt(4000 * 0.25 * 0.75));
}

/// A setting outside the sample is not looked at: the sample is what it says it is.
TEST_F(SampleCheck, OnlyTheSampleIsSimulated) {
  write([](MeasureColumns& columns) { columns.values[0][44] = 77; });
  const auto numbers = random_settings(45, 10, 3);
  const bool has_it = std::find(numbers.begin(), numbers.end(), 44u) != numbers.end();
  std::uint64_t last = 0;
  const SampleReport report = check_sample(PortraitReader(in("p.h5")), {.settings = 10, .seed = 3, .threads = 2,
                                                                       .progress = [&](std::uint64_t done) { last = done; }});
  EXPECT_EQ(report.settings, 10u);
  EXPECT_EQ(report.failed, has_it ? 1u : 0u);
  EXPECT_LT(last, 10u);
}

TEST_F(SampleCheck, ASettingThatNoSweepTakesIsNamed) {
  sample::write(in("p.h5"), sample::small_grid());  // c = 0.25 also where there is no integral action
  const std::string message = message_of<IntegrityError>([&] { checked(); });  // that of any thread
  EXPECT_NE(message.find(" of the portrait is no loop: "), std::string::npos) << message;
}

}  // namespace
}  // namespace portrait
