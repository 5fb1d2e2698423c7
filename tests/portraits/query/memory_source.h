/// A portrait in memory, for tests.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "engine/base/check.h"
#include "portraits/column_source.h"

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
  std::uint64_t values_read() const { return values_read_; }
  std::size_t longest_read() const { return longest_read_; }

  const Grid& grid() const override { return grid_; }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override {
    cut(columns_.at(measure), first, count, values);
    values_read_ += count;
  }
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override {
    cut(statuses_, first, count, statuses);
  }

 private:
  template <typename T>
  void cut(const std::vector<T>& all, std::uint64_t first, std::size_t count, std::vector<T>& part) const {
    PORTRAIT_CHECK(first + count <= all.size());
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    part.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    longest_read_ = std::max(longest_read_, count);
  }

  Grid grid_;
  std::map<Measure, std::vector<double>> columns_;
  std::vector<Status> statuses_;
  mutable std::uint64_t values_read_ = 0;
  mutable std::size_t longest_read_ = 0;
};

}  // namespace portrait
