/// A portrait in memory, for tests.
#pragma once

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/check.h"
#include "portraits/column_source.h"
#include "portraits/tile_rows.h"

namespace portrait {

class MemorySource final : public ColumnSource {
 public:
  /// Every setting settled, every measure 1.
  explicit MemorySource(Grid grid) : grid_(std::move(grid)), statuses_(setting_count(grid_), Status::settled) {
    for (const Measure measure : grid_.measures) columns_[measure].assign(statuses_.size(), 1.0);
  }

  double& at(Measure measure, std::uint64_t number) { return columns_.at(measure).at(number); }
  double at(Measure measure, std::uint64_t number) const { return columns_.at(measure).at(number); }
  Status& status(std::uint64_t number) { return statuses_.at(number); }
  Status status(std::uint64_t number) const { return statuses_.at(number); }
  void set(Measure measure, std::vector<double> values) {
    PORTRAIT_CHECK_EQ(values.size(), statuses_.size());
    columns_.at(measure) = std::move(values);
  }
  /// Numbers given out so far, measures only.
  std::uint64_t values_read() const { return *values_read_; }
  std::size_t longest_read() const { return *longest_read_; }

  /// Whether it says what is known of each tile, as a portrait does; an older one does not.
  void know_summaries(bool known) { knows_summaries_ = known; }

  const Grid& grid() const override { return grid_; }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override {
    cut(columns_.at(measure), first, count, values);
    *values_read_ += count;
  }
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override {
    cut(statuses_, first, count, statuses);
  }
  std::vector<TileRange> tile_ranges(Measure measure) const override {
    return of_each_tile<TileRange>(columns_.at(measure),
                                   [](auto bytes) { return range_of(bytes, sizeof(double)); });
  }
  std::vector<StatusCounts> tile_status_counts() const override {
    return of_each_tile<StatusCounts>(statuses_, status_counts_of);
  }
  std::unique_ptr<ColumnSource> for_another_thread() const override {
    return std::make_unique<MemorySource>(*this);
  }

 private:
  template <typename Summary, typename T, typename Make>
  std::vector<Summary> of_each_tile(const std::vector<T>& all, Make make) const {
    std::vector<Summary> summaries;
    const TileRows rows(grid_);
    for (std::uint64_t tile = 0; knows_summaries_ && tile < rows.tile_count(); ++tile) {
      const SettingRange range = rows.range(tile);
      summaries.push_back(make(std::as_bytes(std::span(all).subspan(range.first, range.count))));
    }
    return summaries;
  }

  template <typename T>
  void cut(const std::vector<T>& all, std::uint64_t first, std::size_t count, std::vector<T>& part) const {
    PORTRAIT_CHECK(first + count <= all.size());
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    part.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    std::uint64_t longest = *longest_read_;
    while (longest < count && !longest_read_->compare_exchange_weak(longest, count)) {
    }
  }

  Grid grid_;
  std::map<Measure, std::vector<double>> columns_;
  std::vector<Status> statuses_;
  bool knows_summaries_ = true;
  std::shared_ptr<std::atomic<std::uint64_t>> values_read_ = std::make_shared<std::atomic<std::uint64_t>>(0);
  std::shared_ptr<std::atomic<std::uint64_t>> longest_read_ = std::make_shared<std::atomic<std::uint64_t>>(0);
};

}  // namespace portrait
