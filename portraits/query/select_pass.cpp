#include "portraits/query/select_pass.h"

#include <algorithm>
#include <cmath>

#include "portraits/query/workers.h"

namespace portrait {
namespace {

class Selecting {
 public:
  Selecting(const Sheet& sheet, const Expression& objective, const std::vector<Constraint>& where)
      : sheet_(sheet), objective_(objective), where_(where) {}

  /// Everything but the best of tiles that are admissible throughout: those wait.
  void first(Selection& selection, TilePage& page, std::uint64_t tile) const {
    const Outlook slice = sheet_.in_slice(tile);
    if (slice == Outlook::never) return;
    const bool is_counted = count_unread(sheet_, tile, selection.counted);
    if (is_counted && sheet_.most_eligible(tile) == 0) return;
    thread_local std::vector<Interval> stack;
    thread_local std::vector<const Constraint*> open;
    const bool possible = undecided(tile, stack, open);
    if (is_counted && !possible) return;
    const Interval bound = sheet_.bound(objective_, tile, stack);
    if (is_counted && open.empty() && !bound.may_be_nan) {
      selection.admissible += sheet_.most_eligible(tile);
      selection.waiting.emplace_back(bound.low, tile);
      return;
    }
    read(selection, page, tile, open, bound, is_counted, possible);
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
  /// False when a constraint holds nowhere in the tile; `open` gets those that hold in a part of it, perhaps.
  bool undecided(std::uint64_t tile, std::vector<Interval>& stack, std::vector<const Constraint*>& open) const {
    open.clear();
    for (const Constraint& constraint : where_) {
      const Outlook outlook = sheet_.outlook(constraint, tile, stack);
      if (outlook == Outlook::never) return false;
      if (outlook == Outlook::maybe) open.push_back(&constraint);
    }
    return true;
  }

  void read(Selection& selection, TilePage& page, std::uint64_t tile, const std::vector<const Constraint*>& open,
            const Interval& bound, bool is_counted, bool possible) const {
    thread_local std::vector<std::size_t> chosen;
    thread_local Filter filter;
    page.open(tile);
    choose(sheet_, page, chosen, is_counted ? nullptr : &selection.counted);
    if (!possible) return;
    for (const Constraint* constraint : open) filter.keep(*constraint, page, chosen);
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
  const std::vector<Constraint>& where_;
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
