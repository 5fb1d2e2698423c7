#include "portraits/query/query.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/query/price_pass.h"
#include "portraits/query/select_pass.h"

namespace portrait {
namespace {

class Asking {
 public:
  Asking(const ColumnSource& source, const Question& question)
      : source_(source),
        question_(question),
        sheet_(source, conditions().units, used(question), conditions().include_not_settled) {}

  Answer answer() const {
    const Selection selection =
        select(sheet_, question_.minimize, conditions().where, question_.top, conditions().threads);
    Answer answer;
    answer.admissible = selection.admissible;
    answer.total = selection.counted.total;
    answer.left_out = selection.counted.left_out;
    for (const Candidate& candidate : selection.best.sorted()) answer.top.push_back(found(candidate));
    answer.active = active(answer.top.empty() ? std::nullopt : std::optional(answer.top[0].objective));
    if (answer.admissible == 0 || question_.count_excluded) explain_into(answer);
    return answer;
  }

 private:
  const Conditions& conditions() const { return question_.conditions; }

  static std::vector<Quantity> used(const Question& question) {
    std::vector<Quantity> all;
    collect(question.minimize, all);
    for (const Constraint& constraint : question.conditions.where) collect(constraint, all);
    return all;
  }

  Found found(const Candidate& candidate) const {
    return found_at(source_, conditions().units, candidate.number, candidate.objective);
  }

  /// Without the constraint the best is the better of the optimum and the best setting that it alone excludes.
  std::vector<ActiveConstraint> active(std::optional<double> optimum) const {
    std::vector<ActiveConstraint> all;
    const Prices prices = price(sheet_, question_.minimize, conditions().where, optimum, conditions().threads);
    for (std::size_t j = 0; j < prices.by_constraint.size(); ++j) {
      const Price& price = prices.by_constraint[j];
      if (!price.without) continue;
      all.push_back({j, found(*price.without), std::nullopt});
      if (const auto& least = price.loosened)
        all.back().loosened = {found(least->candidate), least->left, least->right, least->violation};
    }
    return all;
  }

  void explain_into(Answer& answer) const {
    const Explanation why = explain(sheet_, question_.minimize, conditions().where, conditions().threads);
    answer.excluded = why.excluded;
    if (answer.admissible > 0) return;
    const auto most = std::max_element(why.excluded.begin(), why.excluded.end());
    if (most != why.excluded.end() && *most > 0)
      answer.strictest = static_cast<std::size_t>(most - why.excluded.begin());
    if (why.nearest) answer.near_miss = NearMiss{found(why.nearest->candidate), why.nearest->violations};
  }

  const ColumnSource& source_;
  const Question& question_;
  Sheet sheet_;
};

}  // namespace

void require_answerable(const Conditions& conditions, const Grid& grid) {
  for (const Constraint& constraint : conditions.where)
    require_available(constraint, grid, conditions.units.plant.has_value());
  require_fits(conditions.units, grid);
}

Found found_at(const ColumnSource& source, const QueryUnits& units, std::uint64_t number, double objective) {
  Found found{number, setting_at(source.grid(), number), {}, objective, Status::not_computed};
  std::vector<double> value;
  std::vector<Status> status;
  for (const Measure measure : source.grid().measures) {
    source.read(measure, number, 1, value);
    found.measures[measure] = value.at(0) * factor(measure, units);
  }
  source.read_statuses(number, 1, status);
  found.status = status.at(0);
  return found;
}

Answer ask(const ColumnSource& source, const Question& question) {
  if (question.top < 1 || question.top > kMaxTop)
    throw InputError(fmt::format("top must be 1 .. {} (it is {})", kMaxTop, question.top));
  require_available(question.minimize, source.grid(), question.conditions.units.plant.has_value());
  require_answerable(question.conditions, source.grid());
  return Asking(source, question).answer();
}

}  // namespace portrait
