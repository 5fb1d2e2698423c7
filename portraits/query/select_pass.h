/// First pass of a query: which settings are admissible, and which of them are best.
///
/// A tile that some constraint rules out is not read. One that every constraint admits is counted by its statuses, and
/// read only when its objective may be good enough. Of the others as few columns are read as can decide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "portraits/query/candidates.h"
#include "portraits/query/ranking.h"

namespace portrait {

struct Selection {
  explicit Selection(std::size_t top) : best(top) {}
  void merge(const Selection& other);

  Ranking best;  ///< of the admissible ones
  std::uint64_t admissible = 0;
  Counted counted;
  std::vector<std::pair<double, std::uint64_t>> waiting;  ///< tiles to read last: least objective, tile
};

/// REQUIRES: the sheet has what the expressions name.
Selection select(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
                 std::size_t top, int threads);

}  // namespace portrait
