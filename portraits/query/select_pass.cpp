#include "portraits/query/select_pass.h"

#include <algorithm>
#include <cmath>

#include "portraits/query/admission.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

class Selecting {
 public:
  Selecting(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where)
      : sheet_(sheet), objective_(objective), admission_(sheet, where) {}

  /// Everything but the best of tiles that are admissible throughout: those wait.
  void first(Selection& selection, TilePage& page, std::uint64_t tile) const {
    thread_local std::vector<Interval> stack;
    thread_local Admission::Glance glance;
    if (!admission_.glance(tile, selection.counted, glance)) return;
    const Interval bound = sheet_.bound(objective_, tile, stack);
    if (!glance.whole() || bound.may_be_nan) return read(selection, page, tile, glance, bound);
    selection.admissible += sheet_.most_eligible(tile);
    selection.waiting.emplace_back(bound.low, tile);
  }

  /// A tile that waited, unless others are better throughout. They come in order of their least objective.
  void second(Selection& selection, TilePage& page, std::uint64_t tile, double least) const {
    if (least > enough_.value()) return;
    page.open(tile);
    thread_local std::vector<std::size_t> chosen;
    choose(sheet_, page, chosen);
    offer(selection, page, chosen);
  }

 private:
  void read(Selection& selection, TilePage& page, std::uint64_t tile, const Admission::Glance& glance,
            const Interval& bound) const {
    thread_local std::vector<std::size_t> chosen;
    admission_.choose(tile, glance, page, selection.counted, chosen);
    if (chosen.empty()) return;
    if (!bound.may_be_nan && bound.low > enough_.value())
      selection.admissible += chosen.size();  // none of them comes into the ranking
    else
      selection.admissible += offer(selection, page, chosen);
  }

  /// How many have an objective.
  std::uint64_t offer(Selection& selection, TilePage& page, const std::vector<std::size_t>& chosen) const {
    thread_local std::vector<double> objectives;
    page.evaluate(objective_, objectives);
    std::uint64_t count = 0;
    for (const std::size_t i : chosen) {
      if (std::isnan(objectives[i])) {
        ++selection.counted.left_out.objective_missing;
        continue;
      }
      ++count;
      selection.best.offer({page.range().first + i, objectives[i], page.statuses()[i]});
    }
    enough_.lower(selection.best.worst_that_enters());
    return count;
  }

  const Sheet& sheet_;
  const Expression& objective_;
  Admission admission_;
  mutable SharedLeast enough_;  ///< some thread's ranking is full of objectives at most this
};

}  // namespace

void Selection::merge(const Selection& other) {
  for (const Candidate& candidate : other.best.sorted()) best.offer(candidate);
  admissible += other.admissible;
  counted.merge(other.counted);
  waiting.insert(waiting.end(), other.waiting.begin(), other.waiting.end());
}

Selection select(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where,
                 std::size_t top, int threads) {
  const Selecting selecting(sheet, objective, where);
  Selection all = share(
      sheet, threads, sheet.rows().tile_count(), Selection(top),
      [&](Selection& selection, TilePage& page, std::uint64_t tile) { selecting.first(selection, page, tile); });
  auto order = std::move(all.waiting);
  all.waiting.clear();
  std::sort(order.begin(), order.end());
  all.merge(share(sheet, threads, order.size(), Selection(top),
                  [&](Selection& selection, TilePage& page, std::uint64_t k) {
                    selecting.second(selection, page, order[k].second, order[k].first);
                  }));
  return all;
}

}  // namespace portrait
