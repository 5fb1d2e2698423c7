#include "tools/plot_rules.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/output.h"

namespace portrait::tools {
namespace {

std::string rule_label(const RuleOnPortrait& r, const Question& question) {
  std::string label(r.rule->name);
  if (!std::isnan(r.regret)) label += fmt::format(", regret {:.3g}", r.regret);
  return r.admissible ? label : fmt::format("{}, {}", label, rule_remark(question, r));
}

}  // namespace

std::vector<pictures::Mark> rule_marks(const Grid& grid, const std::vector<RuleOnPortrait>& rules,
                                       const Question& question,
                                       const std::function<pictures::Point(const RuleOnPortrait&)>& place,
                                       const std::function<bool(pictures::Point)>& inside) {
  std::vector<pictures::Mark> marks;
  std::vector<std::string_view> elsewhere;
  for (const RuleOnPortrait& r : rules) {
    if (!r.not_applicable.empty()) continue;
    const pictures::Point at = place(r);
    if (has_what_is_fixed(grid, r.setting) && std::isfinite(at.x) && std::isfinite(at.y) && inside(at))
      marks.push_back({at, rule_label(r, question)});
    else
      elsewhere.push_back(r.rule->name);
  }
  if (!elsewhere.empty())
    print_message(fmt::format("note: rules beyond the picture or without value: {}", fmt::join(elsewhere, ", ")));
  return marks;
}

}  // namespace portrait::tools
