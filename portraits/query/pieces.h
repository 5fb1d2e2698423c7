/// The separate pieces of a set of settings: two settings are in one piece when steps to neighbours along one axis at a time
/// lead from one to the other within the set.
///
/// cost      runs along the last axis times axes; memory: a run is two numbers
/// accuracy  equal to a search from setting to setting: tests/portraits/query/kinds_property_test.cpp
#pragma once

#include <cstdint>
#include <vector>

#include "grids/grid.h"
#include "portraits/tile_rows.h"

namespace portrait {

struct Piece {
  std::uint64_t settings = 0;
  std::uint64_t lowest = 0;                ///< number of its first setting
  std::vector<std::uint64_t> first, last;  ///< by axis: indices of its outermost values
};

/// Runs of settings along the last axis, none of them over its end.
class SettingRuns {
 public:
  explicit SettingRuns(const Grid& grid) : row_(grid.axes.empty() ? 1 : grid.axes.back().size()) {}

  /// REQUIRES: one call after the other in the order of their numbers, for numbers that are not merged in.
  void add(std::uint64_t number) {
    const bool goes_on = !runs_.empty() && runs_.back().end() == number && number % row_ != 0;
    if (goes_on)
      ++runs_.back().count;
    else
      runs_.push_back({number, 1});
  }
  void merge(const SettingRuns& other) { runs_.insert(runs_.end(), other.runs_.begin(), other.runs_.end()); }
  const std::vector<SettingRange>& runs() const { return runs_; }

 private:
  std::uint64_t row_;
  std::vector<SettingRange> runs_;
};

/// The largest first, of equal ones that with the lowest number.
std::vector<Piece> pieces_of(const Grid& grid, std::vector<SettingRange> runs);

}  // namespace portrait
