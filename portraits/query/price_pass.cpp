#include "portraits/query/price_pass.h"

#include <algorithm>
#include <cmath>

#include "portraits/query/workers.h"

namespace portrait {
namespace {

/// At most this far do the sides miss each other anywhere in the tile, relative to the right one.
double least_violation(const Constraint& constraint, const Sheet& sheet, std::uint64_t tile,
                       std::vector<Interval>& stack) {
  const Interval left = sheet.bound(constraint.left, tile, stack),
                 right = sheet.bound(constraint.right, tile, stack);
  if (!left.has_numbers() || !right.has_numbers()) return 0;
  const double gap = std::max({left.low - right.high, right.low - left.high, 0.0});
  if (!std::isfinite(gap)) return 0;
  return gap / std::max({std::abs(right.low), std::abs(right.high), kTinyBound}) * (1 - 1e-12);
}

class Pricing {
 public:
  Pricing(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
          std::optional<double> optimum)
      : sheet_(sheet),
        objective_(objective),
        where_(where),
        optimum_(optimum),
        best_(where.size()),
        nearest_(where.size()) {}

  void visit(Prices& prices, TilePage& page, std::uint64_t tile) const {
    if (sheet_.in_slice(tile) == Outlook::never || sheet_.most_eligible(tile) == 0) return;
    thread_local std::vector<Interval> stack;
    const Interval bound = sheet_.bound(objective_, tile, stack);
    if (!bound.has_numbers() || !is_better_than_optimum(bound.low)) return;
    if (matters(tile, bound.low, stack)) read(prices, page, tile);
  }

 private:
  bool is_better_than_optimum(double objective) const {
    return optimum_ ? objective < *optimum_ : !std::isnan(objective);
  }

  /// Whether some constraint may be the only one to fail, and the tile may hold something new about it.
  bool matters(std::uint64_t tile, double least_objective, std::vector<Interval>& stack) const {
    std::optional<std::size_t> never;
    bool fails_somewhere = false;
    thread_local std::vector<std::size_t> suspects;
    suspects.clear();
    for (std::size_t j = 0; j < where_.size(); ++j) {
      const Outlook outlook = sheet_.outlook(where_[j], tile, stack);
      if (outlook == Outlook::always) continue;
      fails_somewhere = true;
      if (outlook == Outlook::never && never) return false;
      if (outlook == Outlook::never) never = j;
      suspects.push_back(j);
    }
    if (!fails_somewhere) return false;
    return std::any_of(suspects.begin(), suspects.end(), [&](std::size_t j) {
      if (never && *never != j) return false;
      return least_objective <= best_[j].value() ||
             least_violation(where_[j], sheet_, tile, stack) <= nearest_[j].value();
    });
  }

  void read(Prices& prices, TilePage& page, std::uint64_t tile) const {
    thread_local std::vector<std::size_t> chosen;
    thread_local std::vector<double> objectives;
    page.open(tile);
    choose(sheet_, page, chosen);
    if (chosen.empty()) return;
    page.evaluate(objective_, objectives);
    std::erase_if(chosen, [&](std::size_t i) { return !is_better_than_optimum(objectives[i]); });
    judge(prices, page, chosen, objectives);
  }

  struct Sides {
    std::vector<double> left, right;
  };

  /// Each of these fails some constraint, since it is better than every admissible one.
  void judge(Prices& prices, TilePage& page, std::vector<std::size_t>& chosen,
             const std::vector<double>& objectives) const {
    thread_local std::vector<Sides> sides;
    thread_local std::vector<std::size_t> failed;  // by setting: the constraint, or none
    const std::size_t none = where_.size();
    sides.resize(where_.size());
    failed.assign(page.range().count, none);
    for (std::size_t j = 0; j < where_.size() && !chosen.empty(); ++j) {
      page.evaluate(where_[j].left, sides[j].left);
      page.evaluate(where_[j].right, sides[j].right);
      std::erase_if(chosen, [&](std::size_t i) {
        if (holds(where_[j].relation, sides[j].left[i], sides[j].right[i])) return false;
        const bool is_second = failed[i] != none;
        failed[i] = j;
        return is_second;
      });
    }
    for (const std::size_t i : chosen) {
      const std::size_t j = failed[i];
      if (j == none) continue;
      const Candidate candidate{page.range().first + i, objectives[i], page.statuses()[i]};
      offer(prices.by_constraint[j], j, candidate, sides[j].left[i], sides[j].right[i]);
    }
  }

  void offer(Price& price, std::size_t j, const Candidate& candidate, double left, double right) const {
    price.offer(candidate);
    best_[j].lower(candidate.objective);
    const double violation = distance(left, right);
    if (std::isnan(violation)) return;
    price.offer({candidate, violation, left, right});
    nearest_[j].lower(violation);
  }

  const Sheet& sheet_;
  const Expression& objective_;
  const std::vector<Constraint>& where_;
  std::optional<double> optimum_;
  mutable std::vector<SharedLeast> best_, nearest_;  ///< by constraint
};

}  // namespace

void Price::offer(const Candidate& candidate) {
  if (!without || is_better(candidate, *without)) without = candidate;
}

void Price::offer(const Loosened& found) {
  const bool nearer = !loosened || found.violation < loosened->violation ||
                      (found.violation == loosened->violation && is_better(found.candidate, loosened->candidate));
  if (nearer) loosened = found;
}

void Prices::merge(const Prices& other) {
  for (std::size_t j = 0; j < by_constraint.size(); ++j) {
    if (other.by_constraint[j].without) by_constraint[j].offer(*other.by_constraint[j].without);
    if (other.by_constraint[j].loosened) by_constraint[j].offer(*other.by_constraint[j].loosened);
  }
}

Prices price(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
             std::optional<double> optimum, int threads) {
  const Prices empty{std::vector<Price>(where.size())};
  if (where.empty()) return empty;
  const Pricing pricing(sheet, objective, where, optimum);
  return share(sheet, threads, sheet.rows().tile_count(), empty,
               [&](Prices& prices, TilePage& page, std::uint64_t tile) { pricing.visit(prices, page, tile); });
}

}  // namespace portrait
