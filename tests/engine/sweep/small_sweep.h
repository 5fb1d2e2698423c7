/// A small grid made by hand, and a place for what a sweep over it stores.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "engine/sweep/sweep.h"

namespace portrait {

/// dipdt with PD and PID control, 60 settings, some of them unstable.
inline std::vector<Setting> small_grid() {
  std::vector<Setting> settings;
  for (const double kappa : {0.05, 0.1, 0.15, 0.3, 0.6})
    for (const double delta : {0.3, 0.5, 0.9})
      for (const double tau_i : {5.0, 8.0, 14.0, kInf})
        settings.push_back({.kappa = kappa, .tau_i = tau_i, .delta = delta});
  return settings;
}

/// What was stored, all tiles in one row.
class Collected {
 public:
  explicit Collected(std::vector<Measure> measures) : columns_(std::move(measures), 0) {}

  void store(std::uint64_t tile, const MeasureColumns& columns) {
    ASSERT_EQ(tile, tiles_++);
    ASSERT_EQ(columns.kept, columns_.kept);
    for (std::size_t k = 0; k < columns.kept.size(); ++k)
      columns_.values[k].insert(columns_.values[k].end(), columns.values[k].begin(), columns.values[k].end());
    columns_.status.insert(columns_.status.end(), columns.status.begin(), columns.status.end());
  }

  const MeasureColumns& columns() const { return columns_; }
  std::uint64_t tiles() const { return tiles_; }

 private:
  MeasureColumns columns_;
  std::uint64_t tiles_ = 0;
};

inline std::vector<Measure> every_measure() {
  const auto all = standard_measures();
  return {all.begin(), all.end()};
}

/// Stores a job's tiles by `store`, with nothing to prepare.
template <typename Store>
void store_with(SweepJob& job, Store store) {
  job.prepare = [store](std::uint64_t tile, const MeasureColumns& columns) -> StoreStep {
    return [store, tile, &columns] { store(tile, columns); };
  };
}

/// A job over `settings` in tiles of `tile_size`; `collected` must outlive it.
inline SweepJob job_over(const std::vector<Setting>& settings, std::size_t tile_size, int threads,
                         Collected& collected) {
  SweepJob job;
  job.family = {.plant = Plant::dipdt, .n = 0, .prefilter = Prefilter::pi};
  job.horizon = Horizon::fixed(15);
  job.sampling = 0.2;
  job.measures = collected.columns().kept;
  job.tile_count = (settings.size() + tile_size - 1) / tile_size;
  job.settings_of = [settings, tile_size](std::uint64_t tile) {
    const auto first = static_cast<std::ptrdiff_t>(tile * tile_size);
    const auto last = std::min(first + static_cast<std::ptrdiff_t>(tile_size), std::ssize(settings));
    return std::vector<Setting>(settings.begin() + first, settings.begin() + last);
  };
  store_with(job,
             [&collected](std::uint64_t tile, const MeasureColumns& columns) { collected.store(tile, columns); });
  job.threads = threads;
  return job;
}

/// Every double bit for bit, NaN included.
inline void expect_same_bits(const MeasureColumns& a, const MeasureColumns& b) {
  EXPECT_EQ(a.status, b.status);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t k = 0; k < a.values.size(); ++k)
    EXPECT_TRUE(std::equal(
        a.values[k].begin(), a.values[k].end(), b.values[k].begin(), b.values[k].end(),
        [](double x, double y) { return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y); }))
        << to_string(a.kept[k]);
}

}  // namespace portrait
