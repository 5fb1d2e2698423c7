/// Published numbers as they stand in the papers: digits kept, with page and conditions. The data files lie in
/// reproduce/data/ and are part of the program.
///
///     [[table]]
///     key = "huba2022/table1"                 paper/table
///     title = "..."   page = "7"   conditions = "..."
///     columns = ["p_o", "kappa"]
///     rows = ["m = 1/2 | -0.33822 0.1161"]    label | one printed number a column; - where the paper has none
///     within = 0.01   within_why = "..."      a number counts as agreeing within this part of it, for this reason
///     [[table.note]]                          what a difference means, for the cells of `rows` and `columns`, all without
///     rows = ["m = 3"]  columns = ["tau_i"]
///     correction = "..."                      what has to be changed for the numbers to come out
///     why = "..."                             why they do not
///
/// throws    InputError with the place in the data file
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace portrait::reproduce {

struct PrintedRow {
  std::string label;
  std::vector<std::optional<std::string>> cells;
};

struct Note {
  std::vector<std::string> rows, columns;  ///< empty: all
  std::string correction, why;
};

struct PublishedTable {
  std::string key, title, page, conditions;
  std::vector<std::string> columns;
  std::vector<PrintedRow> rows;
  double within = 0;
  std::string within_why;
  std::vector<Note> notes;

  /// The note for a cell that has this text, or nullptr.
  const Note* note_for(std::size_t row, std::size_t column, std::string Note::*text) const;
};

/// All tables, in the order of the files.
const std::vector<PublishedTable>& published_tables();

/// The tables of one data file's text.
std::vector<PublishedTable> read_published(std::string_view text, const std::string& source);

/// "2.13e-4" -> the number, and half a unit of its last printed digit.
struct Printed {
  double value, half_unit;
};
Printed printed(const std::string& text);

}  // namespace portrait::reproduce
