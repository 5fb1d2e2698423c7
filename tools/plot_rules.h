/// --rules of `portrait plot map` and `front`: tuning rules as numbered points, each with its regret.
#pragma once

#include <functional>
#include <vector>

#include "tools/pictures/map.h"
#include "tools/query_rules.h"

namespace portrait::tools {

/// The rules that have what the grid fixes, and that `place` puts at a finite point which `inside` holds, labelled "simc-pi, regret 1.53" or with why they are
/// not admissible. Those that apply but lie elsewhere are named in one message on stderr.
std::vector<pictures::Mark> rule_marks(const Grid& grid, const std::vector<RuleOnPortrait>& rules,
                                       const Question& question,
                                       const std::function<pictures::Point(const RuleOnPortrait&)>& place,
                                       const std::function<bool(pictures::Point)>& inside);

}  // namespace portrait::tools
