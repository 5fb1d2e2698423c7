#include "reproduce/published.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "grids/toml.h"
#include "reproduce/data.h"

namespace portrait::reproduce {
namespace {

std::string text_or_nothing(const Value::Table& table, std::string_view key) {
  const Entry* entry = find(table, key);
  return entry ? text_in(key, entry->value) : "";
}

std::vector<std::string> texts(std::string_view key, const Value& value) {
  std::vector<std::string> all;
  for (const Value& item : list_in(key, value)) all.push_back(text_in(key, item));
  return all;
}

std::vector<std::string> texts_or_none(const Value::Table& table, std::string_view key) {
  const Entry* entry = find(table, key);
  return entry ? texts(key, entry->value) : std::vector<std::string>{};
}

PrintedRow row(const Value& value, std::size_t columns) {
  const std::string& text = text_in("rows", value);
  const auto bar = text.find('|');
  if (bar == std::string::npos) throw InputError(value.place, "a row is \"label | number number ...\"");
  PrintedRow row{text.substr(0, text.find_last_not_of(' ', bar - 1) + 1), {}};
  std::istringstream cells(text.substr(bar + 1));
  for (std::string cell; cells >> cell;) {
    if (cell != "-" && !parse_number(cell))
      throw InputError(value.place, fmt::format("\"{}\" is not a number", cell));
    row.cells.push_back(cell == "-" ? std::nullopt : std::optional(cell));
  }
  if (row.cells.size() != columns)
    throw InputError(value.place, fmt::format("{} numbers for {} columns", row.cells.size(), columns));
  return row;
}

Note note(const Value& value) {
  const Value::Table& table = table_in("note", value);
  allow_only(table, {"rows", "columns", "correction", "why"});
  return {texts_or_none(table, "rows"), texts_or_none(table, "columns"), text_or_nothing(table, "correction"),
          text_or_nothing(table, "why")};
}

/// Names in a note that the table does not have explain nothing.
void check_names(const Value& where, const PublishedTable& t) {
  for (const Note& n : t.notes) {
    for (const std::string& name : n.columns)
      if (std::find(t.columns.begin(), t.columns.end(), name) == t.columns.end())
        throw InputError(where.place, fmt::format("{}: a note names the column \"{}\"", t.key, name));
    for (const std::string& name : n.rows)
      if (std::none_of(t.rows.begin(), t.rows.end(), [&](const PrintedRow& r) { return r.label == name; }))
        throw InputError(where.place, fmt::format("{}: a note names the row \"{}\"", t.key, name));
  }
}

PublishedTable table(const Value& value) {
  const Value::Table& t = table_in("table", value);
  allow_only(t, {"key", "title", "page", "conditions", "columns", "rows", "within", "within_why", "note"});
  PublishedTable made{text_in("key", need(value, "key").value),
                      text_in("title", need(value, "title").value),
                      text_in("page", need(value, "page").value),
                      text_or_nothing(t, "conditions"),
                      texts("columns", need(value, "columns").value),
                      {},
                      0,
                      text_or_nothing(t, "within_why"),
                      {}};
  if (const Entry* within = find(t, "within")) made.within = number_in("within", within->value);
  for (const Value& item : list_in("rows", need(value, "rows").value))
    made.rows.push_back(row(item, made.columns.size()));
  if (const Entry* notes = find(t, "note"))
    for (const Value& item : list_in("note", notes->value)) made.notes.push_back(note(item));
  check_names(value, made);
  return made;
}

bool names(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

const Note* PublishedTable::note_for(std::size_t r, std::size_t c, std::string Note::*text) const {
  for (const Note& n : notes)
    if (!(n.*text).empty() && names(n.rows, rows[r].label) && names(n.columns, columns[c])) return &n;
  return nullptr;
}

std::vector<PublishedTable> read_published(std::string_view text, const std::string& source) {
  const Value root = parse_toml(text, source);
  std::vector<PublishedTable> all;
  for (const Value& item : list_in("table", need(root, "table").value)) all.push_back(table(item));
  return all;
}

const std::vector<PublishedTable>& published_tables() {
  static const std::vector<PublishedTable> all = [] {
    std::vector<PublishedTable> joined;
    for (const DataFile& file : data_files())
      for (PublishedTable& t : read_published(file.text, std::string(file.name))) joined.push_back(std::move(t));
    return joined;
  }();
  return all;
}

Printed printed(const std::string& text) {
  const std::size_t e = std::min(text.find_first_of("eE"), text.size());
  const std::size_t point = text.find('.');
  const int decimals = point < e ? static_cast<int>(e - point) - 1 : 0;
  const int exponent = e < text.size() ? std::stoi(text.substr(e + 1)) : 0;
  return {parse_number(text).value(), 0.5 * std::pow(10.0, exponent - decimals)};
}

}  // namespace portrait::reproduce
