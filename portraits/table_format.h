/// Tables as other programs read them: CSV as text, and NPY, numpy's own format, as one array of records.
///
/// CSV   a head of names, a row for each setting; numbers as the shortest text that reads back as the same double, nan and
///       inf as these words, a status as its word
/// NPY   version 1.0: numpy.load gives an array whose fields are the columns, float64, the status uint8 (0 not_computed,
///       1 settled, 2 not_settled, 3 unstable); its shape is that of a slice of the grid, or a row of settings
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace portrait {

struct TableColumn {
  std::string name;
  std::string unit;     ///< what its numbers are
  std::string meaning;  ///< in words
  bool is_status = false;
};

/// Some rows: values[c][row]; a status by its code.
struct TableRows {
  std::vector<std::vector<double>> values;
  std::size_t count = 0;
};

std::string csv_head(const std::vector<TableColumn>& columns);
std::string csv_rows(const std::vector<TableColumn>& columns, const TableRows& rows);

/// As long for any shape of so many dimensions, so that it can be written again when the number of rows is known.
std::string npy_head(const std::vector<TableColumn>& columns, const std::vector<std::uint64_t>& shape);
std::string npy_rows(const std::vector<TableColumn>& columns, const TableRows& rows);

}  // namespace portrait
