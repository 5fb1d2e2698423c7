#include "portraits/query/pareto.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/query/admission.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

/// Points of which none dominates another, sorted by the first value.
class Front {
 public:
  bool is_beaten(const FrontPoint& point) const {
    for (const FrontPoint& one : points_) {
      if (one.values[0] > point.values[0]) break;
      if (dominates(one, point) || (one.values == point.values && one.number < point.number)) return true;
    }
    return false;
  }

  void offer(const FrontPoint& point) {
    if (is_beaten(point)) return;
    std::erase_if(points_, [&](const FrontPoint& one) {
      return one.values[0] >= point.values[0] && (dominates(point, one) || one.values == point.values);
    });
    points_.insert(std::upper_bound(points_.begin(), points_.end(), point, before), point);
  }

  const std::vector<FrontPoint>& points() const { return points_; }

 private:
  static bool before(const FrontPoint& a, const FrontPoint& b) { return a.values < b.values; }
  std::vector<FrontPoint> points_;
};

struct Tally {
  Front front;
  std::uint64_t admissible = 0;
  Counted counted;

  void merge(const Tally& other) {
    for (const FrontPoint& point : other.front.points()) front.offer(point);
    admissible += other.admissible;
    counted.merge(other.counted);
  }
};

class Fronting {
 public:
  Fronting(const Sheet& sheet, const ParetoQuestion& question)
      : sheet_(sheet), question_(question), admission_(sheet, question.conditions.where) {}

  void visit(Tally& tally, TilePage& page, std::uint64_t tile) const {
    thread_local Admission::Glance glance;
    if (!admission_.glance(tile, tally.counted, glance)) return;
    const bool beaten = is_beaten(tally.front, tile);
    if (beaten && glance.whole()) {
      tally.admissible += sheet_.most_eligible(tile);
      return;
    }
    thread_local std::vector<std::size_t> chosen;
    admission_.choose(tile, glance, page, tally.counted, chosen);
    if (beaten) tally.admissible += chosen.size();
    if (!beaten && !chosen.empty()) offer(tally, page, chosen);
  }

 private:
  /// Whether some point of the front dominates whatever the tile can hold, and none of it is NaN.
  bool is_beaten(const Front& front, std::uint64_t tile) const {
    thread_local std::vector<Interval> stack;
    FrontPoint corner{0, {}};
    for (std::size_t k = 0; k < question_.minimize.size(); ++k) {
      const Interval bound = sheet_.bound(question_.minimize[k], tile, stack);
      if (bound.may_be_nan) return false;
      corner.values[k] = bound.low;
    }
    return std::any_of(front.points().begin(), front.points().end(),
                       [&](const FrontPoint& point) { return dominates(point, corner); });
  }

  void offer(Tally& tally, TilePage& page, const std::vector<std::size_t>& chosen) const {
    thread_local std::array<std::vector<double>, kMostObjectives> values;
    const std::size_t objectives = question_.minimize.size();
    for (std::size_t k = 0; k < objectives; ++k) page.evaluate(question_.minimize[k], values[k]);
    for (const std::size_t i : chosen) {
      FrontPoint point{page.range().first + i, {}};
      bool exists = true;
      for (std::size_t k = 0; k < objectives; ++k) {
        point.values[k] = values[k][i];
        exists = exists && !std::isnan(values[k][i]);
      }
      if (!exists) ++tally.counted.left_out.objective_missing;
      if (!exists) continue;
      ++tally.admissible;
      tally.front.offer(point);
    }
  }

  const Sheet& sheet_;
  const ParetoQuestion& question_;
  Admission admission_;
};

/// Every value scaled to 0 .. 1 over the front; one that is the same everywhere to 0, infinite ones to 1.
std::vector<std::array<double, kMostObjectives>> scaled(const std::vector<FrontPoint>& front,
                                                        std::size_t objectives) {
  std::vector<std::array<double, kMostObjectives>> all(front.size());
  for (std::size_t k = 0; k < objectives; ++k) {
    double low = kInf, high = -kInf;
    for (const FrontPoint& point : front) {
      if (!std::isfinite(point.values[k])) continue;
      low = std::min(low, point.values[k]);
      high = std::max(high, point.values[k]);
    }
    for (std::size_t i = 0; i < front.size(); ++i) {
      const double value = front[i].values[k];
      all[i][k] = std::isfinite(value) ? (high > low ? (value - low) / (high - low) : 0) : value > 0 ? 1 : 0;
    }
  }
  return all;
}

double squared_distance(const std::array<double, kMostObjectives>& a,
                        const std::array<double, kMostObjectives>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < kMostObjectives; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace

bool dominates(const FrontPoint& a, const FrontPoint& b) {
  bool smaller = false;
  for (std::size_t k = 0; k < kMostObjectives; ++k) {
    if (a.values[k] > b.values[k]) return false;
    smaller = smaller || a.values[k] < b.values[k];
  }
  return smaller;
}

std::size_t knee_of(const std::vector<FrontPoint>& front, std::size_t objectives) {
  const auto places = scaled(front, objectives);
  const auto sum = [](const std::array<double, kMostObjectives>& place) { return place[0] + place[1] + place[2]; };
  std::size_t knee = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (sum(places[i]) < sum(places[knee])) knee = i;
  return knee;
}

std::vector<std::size_t> even_subset(const std::vector<FrontPoint>& front, std::size_t objectives,
                                     std::size_t size) {
  const auto places = scaled(front, objectives);
  std::vector<std::size_t> chosen = {0};
  std::vector<double> apart(front.size(), kInf);  // from the nearest chosen one
  while (chosen.size() < std::min(size, front.size())) {
    for (std::size_t i = 0; i < front.size(); ++i)
      apart[i] = std::min(apart[i], squared_distance(places[i], places[chosen.back()]));
    const auto farthest = std::max_element(apart.begin(), apart.end());
    if (*farthest == 0) break;  // the rest differs by less than can be told apart
    chosen.push_back(static_cast<std::size_t>(farthest - apart.begin()));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

ParetoAnswer pareto(const ColumnSource& source, const ParetoQuestion& question) {
  const Conditions& conditions = question.conditions;
  if (question.minimize.size() < 2 || question.minimize.size() > kMostObjectives)
    throw InputError(
        fmt::format("a front is over two or three expressions (there are {})", question.minimize.size()));
  if (question.subset < 2) throw InputError("a subset of the front has at least its two ends");
  std::vector<Quantity> used;
  for (const Expression& expression : question.minimize) {
    require_available(expression, source.grid(), conditions.units.plant.has_value());
    collect(expression, used);
  }
  require_answerable(conditions, source.grid());
  for (const Constraint& constraint : conditions.where) collect(constraint, used);
  const Sheet sheet(source, conditions.units, used, conditions.include_not_settled);
  const Fronting fronting(sheet, question);
  const Tally tally = share(sheet, conditions.threads, sheet.rows().tile_count(), Tally(),
                            [&](Tally& t, TilePage& page, std::uint64_t tile) { fronting.visit(t, page, tile); });
  ParetoAnswer answer{tally.front.points(), 0, {}, tally.admissible, tally.counted.total, tally.counted.left_out};
  if (answer.front.empty()) return answer;
  answer.knee = knee_of(answer.front, question.minimize.size());
  answer.subset = even_subset(answer.front, question.minimize.size(), question.subset);
  return answer;
}

}  // namespace portrait
