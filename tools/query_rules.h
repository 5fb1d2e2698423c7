/// portrait query --rules: where each tuning rule lies in a portrait, whether it is admissible, and what it costs.
///
/// A rule's kappa, tau_i and delta are taken as they come and the loop is simulated with the portrait's own filter, prefilter and
/// horizon, so that a rule between grid points, or off the grid, is compared on the same terms as the optimum.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/rules/rule.h"
#include "portraits/query/query.h"
#include "tools/output.h"

namespace portrait::tools {

struct RuleOnPortrait {
  const rules::Rule* rule;
  std::string not_applicable;  ///< why the rule has no setting here; the rest is then empty
  Setting setting;
  MeasureRow measures;  ///< in the question's units
  double objective;
  Status status;
  std::vector<std::string> off_axes;  ///< axes that do not reach the setting
  std::vector<std::size_t> violated;  ///< constraints that do not hold
  bool admissible = false;
  double regret = kNaN;  ///< objective over the optimum's; NaN without an optimum
};

/// Every rule of the catalogue with its usual options. `optimum`: the objective of the query's answer.
/// Throws InputError when the portrait's plant is not known: tau_1 is an axis and no plant was given.
std::vector<RuleOnPortrait> rules_on(const Grid& grid, const Question& question, std::optional<double> optimum);

/// Whether the setting has the values that all settings of the grid have: a rule with derivative action has no place in a
/// portrait of PI controllers.
bool has_what_is_fixed(const Grid& grid, const Setting& setting);

/// "admissible", or why not.
std::string rule_remark(const Question& question, const RuleOnPortrait& r);

Json json_rules(const Grid& grid, const Question& question, const std::vector<RuleOnPortrait>& rules);
std::string rules_text(const Grid& grid, const Question& question, const std::vector<RuleOnPortrait>& rules);

}  // namespace portrait::tools
