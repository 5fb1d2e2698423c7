/// A portrait as a question sees it: in its units, tile by tile, each quantity bounded before it is read.
///
/// Sheet is what all threads share: what is known of the tiles, and where parameters come from. A TilePage is one
/// thread's look at one tile: statuses and columns, each read when first asked for.
///
/// unit      those of the question: measures scaled, parameters normalised, controller values real
/// memory    three numbers per tile for each measure in use, four for the status; a page holds a tile's columns
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "portraits/column_source.h"
#include "portraits/query/constraint.h"
#include "portraits/query/parameter_columns.h"
#include "portraits/query/query_units.h"
#include "portraits/tile_rows.h"

namespace portrait {

class Sheet {
 public:
  /// `used`: every quantity that will be asked for. REQUIRES: `source` outlives the sheet; the units fit the grid.
  Sheet(const ColumnSource& source, const QueryUnits& units, const std::vector<Quantity>& used,
        bool include_not_settled);

  const Grid& grid() const { return source_.grid(); }
  const ColumnSource& source() const { return source_; }
  const QueryUnits& units() const { return units_; }
  const TileRows& rows() const { return rows_; }
  const ParameterColumns& parameters() const { return parameters_; }
  const std::vector<Quantity>& used() const { return used_; }
  const std::optional<double>& slice() const { return slice_; }
  double factor(Measure measure) const { return factors_[static_cast<std::size_t>(measure)]; }

  bool has_right_status(Status status) const {
    return status == Status::settled || (include_not_settled_ && status == Status::not_settled);
  }

  /// Whether the tile belongs to the slice tau_1 = T1/Td of a plant; always, when there is no slice.
  Outlook in_slice(std::uint64_t tile) const;
  /// tau_1, or tau_j. REQUIRES: there is a slice.
  Parameter sliced_parameter() const { return lag_parameter(units_.plant->family).value(); }
  /// Nothing when the source does not know.
  const StatusCounts* status_counts(std::uint64_t tile) const {
    return status_counts_.empty() ? nullptr : &status_counts_[tile];
  }
  /// Of right status; all of the tile when that is not known.
  std::uint64_t most_eligible(std::uint64_t tile) const;

  /// Encloses the quantity over the settings of right status in the tile.
  Interval bound(Quantity quantity, std::uint64_t tile) const;
  Interval bound(const Expression& expression, std::uint64_t tile, std::vector<Interval>& stack) const;
  Outlook outlook(const Constraint& constraint, std::uint64_t tile, std::vector<Interval>& stack) const;

 private:
  Interval bound_of(Measure measure, std::uint64_t tile) const;
  Interval bound_of(ControllerValue value, std::uint64_t tile) const;

  const ColumnSource& source_;
  QueryUnits units_;
  bool include_not_settled_;
  std::vector<Quantity> used_;
  TileRows rows_;
  ParameterColumns parameters_;
  std::optional<double> slice_;
  std::array<double, kMeasureCount> factors_;
  std::array<std::vector<TileRange>, kMeasureCount> ranges_;
  std::vector<StatusCounts> status_counts_;
};

class TilePage {
 public:
  /// `source` is for this thread alone: Sheet::source or one of its for_another_thread.
  TilePage(const Sheet& sheet, const ColumnSource& source) : sheet_(sheet), source_(source) {}

  void open(std::uint64_t tile);
  const SettingRange& range() const { return range_; }

  const std::vector<Status>& statuses();
  /// Whether each setting of the tile belongs to the slice.
  bool is_in_slice(std::size_t i);
  /// `values` gets one value per setting of the tile.
  void evaluate(const Expression& expression, std::vector<double>& values);

 private:
  void require(Quantity quantity);
  void read(Measure measure, std::vector<double>& values);
  void read(ControllerValue value, std::vector<double>& values);

  const Sheet& sheet_;
  const ColumnSource& source_;
  SettingRange range_;
  Columns columns_;
  std::array<bool, kQuantityCount> there_{};
  std::vector<Status> statuses_;
  bool statuses_there_ = false;
  ColumnStack stack_;
};

/// The quantities that expressions name, each once.
void collect(const Expression& expression, std::vector<Quantity>& used);
void collect(const Constraint& constraint, std::vector<Quantity>& used);

}  // namespace portrait
