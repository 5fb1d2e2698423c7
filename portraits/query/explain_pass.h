/// Why a question has no admissible setting: how many each constraint excludes, and which setting comes nearest. Reads
/// every column in use, of every tile.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "portraits/query/candidates.h"
#include "portraits/query/ranking.h"

namespace portrait {

struct Violation {
  std::size_t constraint;  ///< index in Question::where
  double left, right;      ///< values of the two sides
  double relative;         ///< distance(left, right): 0 for x < x
};

struct Explanation {
  struct Nearest {
    Candidate candidate;
    double worst;  ///< largest relative violation
    std::vector<Violation> violations;
  };
  std::vector<std::uint64_t> excluded;  ///< by constraint: settings of right status for which it does not hold
  std::optional<Nearest>
      nearest;  ///< has an objective, and no NaN in a constraint that fails; of equals the lower number

  void merge(const Explanation& other);
  void offer(const Nearest& found);
};

Explanation explain(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
                    int threads);

}  // namespace portrait
