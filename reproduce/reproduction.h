/// Every published table recomputed: which code makes which table, and the tables with their verdicts.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "reproduce/verdict.h"

namespace portrait::reproduce {

/// Fills the numbers of a table, row by row, as many a row as it has columns.
using Numbers = std::vector<std::vector<Computed>>;
using Recompute = Numbers (*)(const PublishedTable& table);

struct Maker {
  std::string_view key;
  Recompute recompute;
};

std::vector<Maker> huba2022_makers();
std::vector<Maker> dalen2018_makers();
std::vector<Maker> huba2021_makers();
std::vector<Maker> ho_pid_makers();
std::vector<Maker> kos2021_makers();

/// A table with a verdict where the paper has a number.
struct Reproduction {
  const PublishedTable* table;
  std::vector<std::vector<std::optional<Compared>>> cells;

  std::array<int, 3> counts() const;  ///< by Verdict
};

Reproduction reproduce(const PublishedTable& table);

/// Tables whose key is `key`, or begins with "key/"; all for an empty one. Throws InputError with the nearest key.
std::vector<const PublishedTable*> tables_named(std::string_view key);

}  // namespace portrait::reproduce
