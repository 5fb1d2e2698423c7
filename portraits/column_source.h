/// Where a query takes its columns from: the stored portrait, or numbers in memory in a test.
///
/// shape     settings are numbered 0 .. setting_count(grid()) - 1, the last axis fastest; a read is a run of them
/// unit      normalised, as the portrait is; a missing measure is NaN
/// errors    those of the store: StoreError, IntegrityError
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/status.h"
#include "engine/measures/catalogue.h"
#include "grids/grid.h"
#include "portraits/tile_summary.h"

namespace portrait {

class ColumnSource {
 public:
  virtual ~ColumnSource() = default;
  virtual const Grid& grid() const = 0;

  /// Settings first .. first + count - 1 of one measure; `values` is resized to `count`.
  /// REQUIRES: the measure is one of grid().measures, and the run lies within the grid.
  virtual void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const = 0;
  /// The same run of outcomes. REQUIRES: the run lies within the grid.
  virtual void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const = 0;

  /// What is known of every tile of TileRows(grid()) without reading it; empty: nothing is, so all must be read.
  /// REQUIRES: the measure is one of grid().measures.
  virtual std::vector<TileRange> tile_ranges(Measure) const { return {}; }
  virtual std::vector<StatusCounts> tile_status_counts() const { return {}; }

  /// The same columns for another thread to read, at the same time as this one.
  virtual std::unique_ptr<ColumnSource> for_another_thread() const = 0;
};

}  // namespace portrait
