#include "engine/sweep/sweep.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "engine/isa/dispatch.h"
#include "engine/reference/measure.h"
#include "tests/engine/base/message_of.h"
#include "tests/engine/sweep/small_sweep.h"

namespace portrait {
namespace {

TEST(Sweep, StoresWhatTheReferenceMeasures) {
  const std::vector<Setting> settings = small_grid();
  Collected collected(every_measure());
  SweepJob job = job_over(settings, 7, 1, collected);
  job.method = Method::reference;
  const SweepOutcome outcome = sweep(job);

  MeasureColumns expected(every_measure(), settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const reference::Measured measured =
        reference::measure({job.family, settings[i]}, job.horizon, {}, job.sampling);
    expected.set(i, measured.status, measured.measures);
  }
  expect_same_bits(collected.columns(), expected);
  EXPECT_EQ(outcome.settings_measured, settings.size());
  EXPECT_EQ(outcome.settings_by_reference, settings.size());
  EXPECT_EQ(outcome.tiles_stored, job.tile_count);
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.threads, 1);
  EXPECT_GT(outcome.seconds, 0);
}

TEST(Sweep, UsesTheKernelUnlessToldOtherwise) {
  const std::vector<Setting> settings = small_grid();
  Collected collected(every_measure());
  const SweepJob job = job_over(settings, 7, 1, collected);
  EXPECT_EQ(sweep(job).settings_by_reference, 0u);

  std::vector<SettingMeasured> measured(settings.size());
  measure_settings(Method::kernel, job.family, job.horizon, {.sampling = job.sampling}, settings, measured);
  MeasureColumns expected(every_measure(), settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) expected.set(i, measured[i].status, measured[i].measures);
  expect_same_bits(collected.columns(), expected);
}

/// A kick of the derivative that no panel of the kernel resolves: measured nevertheless, and counted.
TEST(Sweep, LeavesWhatTheKernelCannotResolveToTheReference) {
  std::vector<Setting> settings(3, {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1});
  settings[1].tau_f = 1e-9;
  Collected collected(every_measure());
  SweepJob job = job_over(settings, 3, 1, collected);
  job.family = {Plant::dipdt, 1, Prefilter::none};
  EXPECT_EQ(sweep(job).settings_by_reference, 1u);
  const reference::Measured truth = reference::measure({job.family, settings[1]}, job.horizon);
  EXPECT_EQ(collected.columns().status[1], truth.status);
  EXPECT_EQ(collected.columns().values[0][1], truth.measures[Measure::IAE_w]);
}

TEST(Sweep, KeepsTheMeasuresAskedFor) {
  const std::vector<Setting> settings = small_grid();
  Collected all(every_measure()), some({Measure::IAE_d, Measure::TV2_uw, Measure::Mt});
  sweep(job_over(settings, 16, 1, all));
  sweep(job_over(settings, 16, 1, some));
  const auto column = [](const MeasureColumns& columns, Measure m) {
    const auto at = std::find(columns.kept.begin(), columns.kept.end(), m) - columns.kept.begin();
    return columns.values[static_cast<std::size_t>(at)];
  };
  MeasureColumns expected(some.columns().kept, settings.size());
  expected.status = all.columns().status;
  for (std::size_t k = 0; k < expected.kept.size(); ++k)
    expected.values[k] = column(all.columns(), expected.kept[k]);
  expect_same_bits(some.columns(), expected);
}

TEST(Sweep, AnUnstableSettingIsNaNAndSaysSo) {
  const std::vector<Setting> settings = {{.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045},
                                         {.kappa = 0.9, .tau_i = 1, .delta = 0.5}};
  Collected collected(every_measure());
  EXPECT_TRUE(sweep(job_over(settings, 2, 1, collected)).complete);
  const MeasureColumns& columns = collected.columns();
  EXPECT_NE(columns.status[0], Status::unstable);
  EXPECT_EQ(columns.status[1], Status::unstable);
  for (std::size_t k = 0; k < columns.kept.size(); ++k) {
    EXPECT_FALSE(std::isnan(columns.values[k][0])) << to_string(columns.kept[k]);
    EXPECT_TRUE(std::isnan(columns.values[k][1])) << to_string(columns.kept[k]);
  }
}

/// A filter without a time constant breaks the sweep's own REQUIRES, which the simulation checks.
TEST(Sweep, AFailingSettingNamesTheCommandThatReproducesIt) {
  std::vector<Setting> settings(5, {.kappa = 0.125, .tau_i = 10, .delta = 0.5, .tau_f = 0.1});
  settings[3].tau_f = 0;
  Collected collected(every_measure());
  SweepJob job = job_over(settings, 2, 1, collected);
  job.family.n = 1;
  job.method = Method::reference;
  const std::string message = message_of([&] { sweep(job); });
  const std::size_t second_line = message.find('\n');
  ASSERT_NE(second_line, std::string::npos) << message;
  EXPECT_NE(message.substr(0, second_line).find("check failed: !why_invalid(loop)"), std::string::npos);
  EXPECT_EQ(message.substr(second_line + 1),
            "reproduce: portrait simulate --plant dipdt --n 1 --prefilter pi --kappa 0.125 --tau-i 10 "
            "--delta 0.5 --tau-f 0 --b 0");
  EXPECT_EQ(collected.tiles(), 1u);
}

TEST(Sweep, AFailureOfTheStoreIsRethrownAsItIs) {
  Collected collected(every_measure());
  SweepJob job = job_over(small_grid(), 7, 1, collected);
  store_with(job, [](std::uint64_t, const MeasureColumns&) { throw std::out_of_range("disk full"); });
  EXPECT_THROW(sweep(job), std::out_of_range);
  EXPECT_EQ(message_of([&] { sweep(job); }), "disk full");
}

TEST(Sweep, AFailureToMakeSettingsIsRethrown) {
  Collected collected(every_measure());
  SweepJob job = job_over(small_grid(), 7, 1, collected);
  job.settings_of = [](std::uint64_t) -> std::vector<Setting> { throw std::out_of_range("no such tile"); };
  EXPECT_EQ(message_of([&] { sweep(job); }), "no such tile");
}

TEST(Sweep, StopsAfterTheSliceInHand) {
  Collected collected(every_measure());
  SweepJob job = job_over(small_grid(), 7, 1, collected);
  std::atomic<bool> stop = false;
  job.stop = &stop;
  store_with(job, [&](std::uint64_t tile, const MeasureColumns& columns) {
    collected.store(tile, columns);
    if (tile == 2) stop = true;
  });
  const SweepOutcome outcome = sweep(job);
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.tiles_stored, 3u);
  EXPECT_EQ(outcome.settings_measured, 21u);
  EXPECT_EQ(collected.tiles(), 3u);
}

TEST(Sweep, ReportsItsProgress) {
  Collected collected(every_measure());
  SweepJob job = job_over(small_grid(), 7, 1, collected);
  std::vector<std::uint64_t> reports;
  job.progress = [&](std::uint64_t measured) { reports.push_back(measured); };
  sweep(job);
  EXPECT_EQ(reports, (std::vector<std::uint64_t>{7, 14, 21, 28, 35, 42, 49, 56, 60}));
}

TEST(Sweep, OfNoTilesIsComplete) {
  Collected collected(every_measure());
  const SweepOutcome outcome = sweep(job_over({}, 7, 1, collected));
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.tiles_stored, 0u);
}

TEST(Sweep, SaysHowItMeasures) {
  EXPECT_EQ(method_text(Method::reference), "reference");
  EXPECT_EQ(method_text(Method::kernel), std::string("kernel, ") + chosen_implementation().name);
}

}  // namespace
}  // namespace portrait
