#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "tests/engine/sweep/small_sweep.h"

namespace portrait {
namespace {

constexpr int kThreads[] = {1, 2, 3, 7};

TEST(SweepThreads, GiveTheSameBitsForAnyNumberAndTileSize) {
  Collected alone(every_measure());
  sweep(job_over(small_grid(), 60, 1, alone));
  for (const int threads : kThreads)
    for (const std::size_t tile_size : {1u, 7u, 33u, 60u}) {
      SCOPED_TRACE(testing::Message() << threads << " threads, tiles of " << tile_size);
      Collected collected(every_measure());
      const SweepOutcome outcome = sweep(job_over(small_grid(), tile_size, threads, collected));
      EXPECT_TRUE(outcome.complete);
      EXPECT_EQ(outcome.threads, threads);
      EXPECT_EQ(outcome.settings_measured, 60u);
      expect_same_bits(collected.columns(), alone.columns());
    }
}

TEST(SweepThreads, AStoppedSweepHasStoredTheFirstTiles) {
  for (const int threads : kThreads) {
    Collected whole(every_measure()), part(every_measure());
    sweep(job_over(small_grid(), 4, 1, whole));
    SweepJob job = job_over(small_grid(), 4, threads, part);
    std::atomic<bool> stop = false;
    job.stop = &stop;
    store_with(job, [&](std::uint64_t tile, const MeasureColumns& columns) {
      part.store(tile, columns);
      stop = true;
    });
    const SweepOutcome outcome = sweep(job);
    EXPECT_EQ(outcome.tiles_stored, part.tiles());
    EXPECT_EQ(outcome.complete, part.tiles() == job.tile_count);
    EXPECT_GE(part.tiles(), 1u);
    MeasureColumns expected = whole.columns();
    expected.status.resize(part.columns().settings());
    for (std::vector<double>& column : expected.values) column.resize(part.columns().settings());
    expect_same_bits(part.columns(), expected);
  }
}

TEST(SweepThreads, AFailureOfTheStoreStopsThemAll) {
  for (const int threads : kThreads) {
    Collected collected(every_measure());
    SweepJob job = job_over(small_grid(), 2, threads, collected);
    store_with(job, [&](std::uint64_t tile, const MeasureColumns& columns) {
      if (tile == 3) throw std::out_of_range("disk full");
      collected.store(tile, columns);
    });
    EXPECT_THROW(sweep(job), std::out_of_range);
    EXPECT_EQ(collected.tiles(), 3u);
  }
}

TEST(SweepThreads, AFailureEndsTheWorkOfTheOthers) {
  const std::vector<Setting> grid = small_grid();
  std::vector<Setting> many;
  for (int i = 0; i < 20; ++i) many.insert(many.end(), grid.begin(), grid.end());
  Collected collected(every_measure());
  SweepJob job = job_over(many, 1, 2, collected);
  std::atomic<std::uint64_t> begun = 0;
  job.settings_of = [&, made = job.settings_of](std::uint64_t tile) {
    ++begun;
    return made(tile);
  };
  store_with(job, [](std::uint64_t, const MeasureColumns&) { throw std::out_of_range("disk full"); });
  EXPECT_THROW(sweep(job), std::out_of_range);
  EXPECT_LT(begun.load(), job.tile_count);
}

TEST(SweepThreads, NoThreadWaitsForAnothersSettings) {
  Collected collected(every_measure());
  SweepJob job = job_over(small_grid(), 4, 2, collected);
  std::atomic<int> inside = 0;
  bool met = false;
  job.settings_of = [&, made = job.settings_of](std::uint64_t tile) {
    ++inside;
    for (int i = 0; tile == 0 && i < 5000 && !met; ++i) {  // until the other thread is here too
      met = inside.load() > 1;
      if (!met) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return made(tile);
  };
  sweep(job);
  EXPECT_TRUE(met);
}

TEST(SweepThreads, AFailureToPrepareStopsThemAll) {
  for (const int threads : kThreads) {
    Collected collected(every_measure());
    SweepJob job = job_over(small_grid(), 2, threads, collected);
    job.prepare = [prepare = job.prepare](std::uint64_t tile, const MeasureColumns& columns) {
      if (tile == 3) throw std::out_of_range("no memory");
      return prepare(tile, columns);
    };
    EXPECT_THROW(sweep(job), std::out_of_range);
    EXPECT_LE(collected.tiles(), 3u);
  }
}

TEST(SweepThreads, AFailingSettingIsNamedWhateverThreadMeetsIt) {
  for (const int threads : kThreads) {
    std::vector<Setting> settings = small_grid();
    settings[31].b = kNaN;  // PD, stable
    Collected collected(every_measure());
    SweepJob job = job_over(settings, 3, threads, collected);
    job.method = Method::reference;
    try {
      sweep(job);
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& failure) {
      EXPECT_NE(std::string(failure.what()).find("\nreproduce: portrait simulate --plant dipdt"),
                std::string::npos);
      EXPECT_NE(std::string(failure.what()).find("--b nan"), std::string::npos);
    }
  }
}

TEST(SweepThreads, ProgressIsReportedByOneAtATime) {
  for (const int threads : kThreads) {
    Collected collected(every_measure());
    SweepJob job = job_over(small_grid(), 1, threads, collected);
    std::atomic<int> inside = 0;
    bool alone = true;
    std::uint64_t largest = 0;
    job.progress = [&](std::uint64_t measured) {
      if (++inside != 1) alone = false;
      largest = std::max(largest, measured);
      --inside;
    };
    sweep(job);
    EXPECT_TRUE(alone);
    EXPECT_GT(largest, 0u);
    EXPECT_LE(largest, 60u);
  }
}

TEST(SweepThreads, WithoutANumberThereAreTheUsualOnes) {
  Collected collected({Measure::Ms});
  EXPECT_GE(usual_threads(), 1);
  EXPECT_EQ(sweep(job_over(small_grid(), 60, 0, collected)).threads, usual_threads());
}

}  // namespace
}  // namespace portrait
