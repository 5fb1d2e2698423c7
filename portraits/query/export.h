/// Settings of a portrait as rows of a table: a slice of the grid, or those that are admissible under conditions.
///
/// shape     without conditions every setting of the slice, whatever its status, in the order of the grid: an array over the
///           axes that the slice leaves. With conditions the admissible settings, as a query counts them, in that order
/// unit      measures in the units of the conditions, axes normalised; with a plant also the values of its controller
/// columns   the grid's axes, values of the controller, status, measures
/// cost      memory: one tile of each column. Tiles outside the slice, or ruled out by their ranges, are not read
/// errors    InputError for names, values of axes, conditions and plants that do not fit the portrait
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "portraits/query/query.h"
#include "portraits/table_format.h"

namespace portrait {

struct ExportRequest {
  Conditions conditions;  ///< `where` empty: every setting of the slice
  std::vector<std::pair<Parameter, double>> slice{};
  std::vector<Measure> measures{};  ///< in the order wanted; REQUIRES: the portrait has them
};

class Export {
 public:
  /// REQUIRES: `source` outlives it.
  Export(const ColumnSource& source, const ExportRequest& request);

  const std::vector<TableColumn>& columns() const { return columns_; }
  /// Axes that the slice leaves, and their sizes, when there are no conditions.
  std::vector<Parameter> free_axes() const;
  std::vector<std::uint64_t> shape() const;

  /// Block by block; gives back the number of rows.
  std::uint64_t for_each(const std::function<void(const TableRows&)>& use) const;
  /// Rows for settings that a query found, in their order.
  TableRows rows_of(const std::vector<Found>& found) const;

 private:
  void fix(Parameter parameter, double value);
  void add_columns();
  std::vector<std::size_t> positions_in(const Box& box) const;
  TableRows rows_at(const Sheet& sheet, SettingRange range, const std::vector<std::size_t>& chosen) const;
  void read(const Sheet& sheet, std::size_t column, SettingRange range, std::vector<double>& values) const;
  double value_of(std::size_t column, const Found& found) const;

  const ColumnSource& source_;
  ExportRequest request_;
  std::vector<std::optional<std::uint64_t>> fixed_;  ///< of each axis, the index that the slice takes
  std::vector<std::optional<Quantity>> quantities_;  ///< of the columns; nothing for the status
  std::vector<TableColumn> columns_;
};

}  // namespace portrait
