#include "reproduce/reproduction.h"

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/base/words.h"

namespace portrait::reproduce {
namespace {

Recompute maker_of(const std::string& key) {
  for (auto* family : {huba2022_makers, dalen2018_makers, huba2021_makers, ho_pid_makers, kos2021_makers})
    for (const Maker& maker : family())
      if (maker.key == key) return maker.recompute;
  check_failed(__FILE__, __LINE__, "a table without code", key);
}

}  // namespace

std::array<int, 3> Reproduction::counts() const {
  std::array<int, 3> counts{};
  for (const auto& row : cells)
    for (const auto& cell : row)
      if (cell) ++counts[static_cast<std::size_t>(cell->verdict)];
  return counts;
}

Reproduction reproduce(const PublishedTable& table) {
  const Numbers numbers = maker_of(table.key)(table);
  PORTRAIT_CHECK_EQ(numbers.size(), table.rows.size());
  Reproduction made{&table, {}};
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    PORTRAIT_CHECK_EQ(numbers[r].size(), table.columns.size());
    auto& row = made.cells.emplace_back(table.columns.size());
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (table.rows[r].cells[c]) row[c] = compared(table, r, c, numbers[r][c]);
  }
  return made;
}

std::vector<const PublishedTable*> tables_named(std::string_view key) {
  std::vector<const PublishedTable*> found;
  std::vector<std::string_view> known;
  for (const PublishedTable& t : published_tables()) {
    if (key.empty() || t.key == key || t.key.starts_with(fmt::format("{}/", key))) found.push_back(&t);
    known.push_back(t.key);
  }
  if (found.empty()) throw InputError(fmt::format("unknown table \"{}\"{}", key, suggestion(key, known)));
  return found;
}

}  // namespace portrait::reproduce
