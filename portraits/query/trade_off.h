/// The best objective along a bound: of the settings with expression <= bound, for a row of bounds. With Ms = 1.3 .. 2.0
/// the Pareto-optimal curve of Dalen2018 (41) and its regret.
///
/// accuracy  equal to one query per bound: tests/portraits/query/kinds_property_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "portraits/query/query.h"

namespace portrait {

struct TradeOffPoint {
  double bound;
  std::optional<Found> best;  ///< nothing when no admissible setting meets the bound
};

/// One pass for all bounds. Throws InputError when question or expression do not fit. REQUIRES: bounds increase.
std::vector<TradeOffPoint> trade_off(const ColumnSource& source, const Question& question, const Expression& along,
                                     const std::vector<double>& bounds);

/// "along <= bound" as a constraint.
Constraint bound_constraint(const Expression& along, double bound);

}  // namespace portrait
