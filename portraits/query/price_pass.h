/// Second pass of a query: what each constraint costs. Without it, all others kept, how good would the best be; and how
/// little must it be loosened before the best gets better?
///
/// Only settings better than the optimum matter here, so most tiles are ruled out by the bound of their objective.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "portraits/query/candidates.h"
#include "portraits/query/ranking.h"

namespace portrait {

/// Of the settings that fail one constraint alone and are better than the optimum.
struct Price {
  struct Loosened {
    Candidate candidate;
    double violation;  ///< distance of the sides, relative to the right one
    double left, right;
  };
  std::optional<Candidate> without;  ///< the best of them
  std::optional<Loosened> loosened;  ///< the one that fails by least; of equals the better

  void offer(const Candidate& candidate);
  void offer(const Loosened& found);
};

struct Prices {
  std::vector<Price> by_constraint;
  void merge(const Prices& other);
};

/// `optimum`: the least objective of all admissible settings, if there is one.
Prices price(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
             std::optional<double> optimum, int threads);

}  // namespace portrait
