#include "portraits/query/explain_pass.h"

#include <algorithm>
#include <cmath>

#include "portraits/query/workers.h"

namespace portrait {
namespace {

class Explaining {
 public:
  Explaining(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where)
      : sheet_(sheet), objective_(objective), where_(where) {}

  void visit(Explanation& explanation, TilePage& page, std::uint64_t tile) const {
    thread_local std::vector<std::size_t> chosen;
    thread_local std::vector<double> objectives;
    thread_local std::vector<Sides> sides;
    page.open(tile);
    choose(sheet_, page, chosen);
    if (chosen.empty()) return;
    sides.resize(where_.size());
    for (std::size_t j = 0; j < where_.size(); ++j) {
      page.evaluate(where_[j].left, sides[j].left);
      page.evaluate(where_[j].right, sides[j].right);
    }
    page.evaluate(objective_, objectives);
    for (const std::size_t i : chosen)
      judge(explanation, {page.range().first + i, objectives[i], page.statuses()[i]}, sides, i);
  }

 private:
  struct Sides {
    std::vector<double> left, right;
  };

  void judge(Explanation& explanation, const Candidate& candidate, const std::vector<Sides>& sides,
             std::size_t i) const {
    Explanation::Nearest miss{candidate, 0, {}};
    bool comparable = !std::isnan(candidate.objective);
    const double to_beat = explanation.nearest ? explanation.nearest->worst : kInf;
    for (std::size_t j = 0; j < where_.size(); ++j) {
      const double left = sides[j].left[i], right = sides[j].right[i];
      if (holds(where_[j].relation, left, right)) continue;
      ++explanation.excluded[j];
      if (!comparable) continue;
      const double relative = distance(left, right);
      comparable = !std::isnan(relative) && relative <= to_beat;
      miss.worst = std::max(miss.worst, relative);
      if (comparable) miss.violations.push_back({j, left, right, relative});
    }
    if (comparable) explanation.offer(miss);
  }

  const Sheet& sheet_;
  const Expression& objective_;
  const std::vector<Constraint>& where_;
};

}  // namespace

void Explanation::offer(const Nearest& found) {
  const bool nearer = !nearest || found.worst < nearest->worst ||
                      (found.worst == nearest->worst && found.candidate.number < nearest->candidate.number);
  if (nearer) nearest = found;
}

void Explanation::merge(const Explanation& other) {
  for (std::size_t j = 0; j < excluded.size(); ++j) excluded[j] += other.excluded[j];
  if (other.nearest) offer(*other.nearest);
}

Explanation explain(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
                    int threads) {
  const Explanation empty{std::vector<std::uint64_t>(where.size(), 0), std::nullopt};
  const Explaining explaining(sheet, objective, where);
  return share(sheet, threads, sheet.rows().tile_count(), empty,
               [&](Explanation& explanation, TilePage& page, std::uint64_t tile) {
                 explaining.visit(explanation, page, tile);
               });
}

}  // namespace portrait
