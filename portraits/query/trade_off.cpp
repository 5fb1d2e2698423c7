#include "portraits/query/trade_off.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/words.h"
#include "portraits/query/admission.h"
#include "portraits/query/ranking.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

/// By bound: the best of the settings that meet it and not the one before.
struct Buckets {
  std::vector<std::optional<Candidate>> best;
  void offer(std::size_t bucket, const Candidate& candidate) {
    auto& held = best[bucket];
    if (!held || is_better(candidate, *held)) held = candidate;
  }
  void merge(const Buckets& other) {
    for (std::size_t i = 0; i < best.size(); ++i)
      if (other.best[i]) offer(i, *other.best[i]);
  }
  /// Of the settings that meet this bound.
  double least(std::size_t bucket) const {
    double objective = kInf;
    for (std::size_t i = 0; i <= bucket; ++i)
      if (best[i]) objective = std::min(objective, best[i]->objective);
    return objective;
  }
};

class Trading {
 public:
  Trading(const Sheet& sheet, const Question& question, const Expression& along, const std::vector<double>& bounds)
      : sheet_(sheet),
        objective_(question.minimize),
        along_(along),
        bounds_(bounds),
        admission_(sheet, question.conditions.where) {}

  void visit(Buckets& buckets, TilePage& page, std::uint64_t tile) const {
    thread_local std::vector<Interval> stack;
    thread_local Admission::Glance glance;
    thread_local std::vector<std::size_t> chosen;
    Counted nothing;
    if (!admission_.glance(tile, nothing, glance) || !glance.possible) return;
    const Interval along = sheet_.bound(along_, tile, stack);
    const std::size_t first = bucket_of(along.low);
    if (!along.has_numbers() || first == bounds_.size()) return;
    const Interval objective = sheet_.bound(objective_, tile, stack);
    if (!objective.has_numbers() || objective.low > buckets.least(first)) return;
    admission_.choose(tile, glance, page, nothing, chosen);
    if (!chosen.empty()) offer(buckets, page, chosen);
  }

 private:
  std::size_t bucket_of(double value) const {
    return static_cast<std::size_t>(std::lower_bound(bounds_.begin(), bounds_.end(), value) - bounds_.begin());
  }

  void offer(Buckets& buckets, TilePage& page, const std::vector<std::size_t>& chosen) const {
    thread_local std::vector<double> objectives, values;
    page.evaluate(objective_, objectives);
    page.evaluate(along_, values);
    for (const std::size_t i : chosen) {
      if (std::isnan(objectives[i]) || std::isnan(values[i])) continue;
      const std::size_t bucket = bucket_of(values[i]);
      if (bucket < bounds_.size())
        buckets.offer(bucket, {page.range().first + i, objectives[i], page.statuses()[i]});
    }
  }

  const Sheet& sheet_;
  const Expression& objective_;
  const Expression& along_;
  const std::vector<double>& bounds_;
  Admission admission_;
};

}  // namespace

std::vector<TradeOffPoint> trade_off(const ColumnSource& source, const Question& question, const Expression& along,
                                     const std::vector<double>& bounds) {
  PORTRAIT_CHECK(std::is_sorted(bounds.begin(), bounds.end()));
  const Conditions& conditions = question.conditions;
  std::vector<Quantity> used;
  for (const Expression* expression : {&question.minimize, &along}) {
    require_available(*expression, source.grid(), conditions.units.plant.has_value());
    collect(*expression, used);
  }
  require_answerable(conditions, source.grid());
  for (const Constraint& constraint : conditions.where) collect(constraint, used);
  const Sheet sheet(source, conditions.units, used, conditions.include_not_settled);
  const Trading trading(sheet, question, along, bounds);
  const Buckets empty{std::vector<std::optional<Candidate>>(bounds.size())};
  const Buckets buckets =
      share(sheet, conditions.threads, sheet.rows().tile_count(), empty,
            [&](Buckets& b, TilePage& page, std::uint64_t tile) { trading.visit(b, page, tile); });
  std::vector<TradeOffPoint> points;
  std::optional<Candidate> best;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (buckets.best[i] && (!best || is_better(*buckets.best[i], *best))) best = buckets.best[i];
    points.push_back({bounds[i], std::nullopt});
    if (best) points.back().best = found_at(source, conditions.units, best->number, best->objective);
  }
  return points;
}

Constraint bound_constraint(const Expression& along, double bound) {
  return parse_constraint({"--along", fmt::format("{} <= {}", along.text(), number_text(bound))});
}

}  // namespace portrait
