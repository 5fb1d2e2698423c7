#include "portraits/query/robust.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/query/select_pass.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

/// Settings whose corners are looked at together, how many are judged at the same time, and how many selected first. Fixed,
/// so that what is counted does not depend on the number of threads.
constexpr std::size_t kWave = 1024, kTogether = 4, kFirstSelected = 4096;

void require_fits(const RobustQuestion& question, const Grid& grid) {
  if (const auto why = why_invalid(question.box)) throw InputError(Place{"--uncertain"}, *why);
  require_available(question.minimize, grid, true);
  for (const Constraint& constraint : question.conditions.where) require_keepable(constraint);
  if (question.top < 1 || question.top > kMaxTop)
    throw InputError(fmt::format("top must be 1 .. {} (it is {})", kMaxTop, question.top));
}

Conditions on_nominal(const RobustQuestion& question) {
  Conditions conditions = question.conditions;
  conditions.units.plant = question.box.nominal;
  return conditions;
}

class Search {
 public:
  Search(const ColumnSource& source, const RobustQuestion& question)
      : source_(source),
        question_(question),
        conditions_(on_nominal(question)),
        trials_(source.grid(), question.box, question.minimize, conditions_),
        examiner_(source.grid(), question.box, trials_),
        best_(question.top) {}

  RobustAnswer run() {
    answer_.broken_by.assign(conditions_.where.size(), 0);
    visit_candidates();
    for (const Candidate& candidate : best_.sorted()) answer_.top.push_back(found(candidate));
    if (first_) answer_.nominal = found(*first_);
    if (const auto& nearest = nearest_ ? nearest_ : first_; answer_.top.empty() && nearest)
      answer_.nearest = examiner_.report(setting_of(*nearest), conditions_.threads);
    return answer_;
  }

 private:
  using Candidates = std::span<const Candidate>;

  /// A candidate that no corner rejects, and what its objective over the box is at least.
  struct Standing {
    Candidate candidate;
    double least;
  };

  Setting setting_of(const Candidate& candidate) const { return setting_at(source_.grid(), candidate.number); }

  RobustFound found(const Candidate& candidate) const {
    return {found_at(source_, conditions_.units, candidate.number, candidate.objective),
            examiner_.report(setting_of(candidate), conditions_.threads)};
  }

  /// In order of the nominal objective. Selecting is cheap and memory is not: a few first, all when they do not do.
  void visit_candidates() {
    std::vector<Quantity> used;
    collect(question_.minimize, used);
    for (const Constraint& constraint : conditions_.where) collect(constraint, used);
    const Sheet sheet(source_, conditions_.units, used, conditions_.include_not_settled);
    std::size_t top = std::max(kFirstSelected, question_.top);
    for (std::size_t done = 0;; top *= 8) {
      const Selection selection = select(sheet, question_.minimize, conditions_.where, top, conditions_.threads);
      const std::vector<Candidate> candidates = selection.best.sorted();
      answer_.admissible = selection.admissible;
      answer_.total = selection.counted.total;
      answer_.left_out = selection.counted.left_out;
      if (!candidates.empty()) first_ = candidates.front();
      for (; done < candidates.size(); done += std::min(kWave, candidates.size() - done)) {
        if (question_.over != Over::mean && candidates[done].objective > best_.worst_that_enters()) return;
        visit(Candidates(candidates).subspan(done, std::min(kWave, candidates.size() - done)));
      }
      if (candidates.size() < top) return;
    }
  }

  void visit(Candidates wave) {
    std::vector<Standing> standing = not_broken_at_corners(wave);
    if (question_.over == Over::mean) standing = with_means(standing);
    std::sort(standing.begin(), standing.end(), [](const Standing& a, const Standing& b) {
      return a.least != b.least ? a.least < b.least : a.candidate.number < b.candidate.number;
    });
    for (std::size_t i = 0; i < standing.size(); i += kTogether) {
      if (standing[i].least > best_.worst_that_enters()) return;
      judge(std::span(standing).subspan(i, std::min(kTogether, standing.size() - i)));
    }
  }

  std::vector<Standing> not_broken_at_corners(Candidates wave) {
    std::vector<Setting> settings;
    for (const Candidate& candidate : wave) settings.push_back(setting_of(candidate));
    const std::vector<double> values = examiner_.at_corners(settings, conditions_.threads);
    const std::size_t functions = trials_.functions(), corners = examiner_.corner_count();
    answer_.examined += wave.size();
    answer_.loops += wave.size() * corners;
    std::vector<Standing> standing;
    for (std::size_t i = 0; i < wave.size(); ++i) {
      std::vector<double> greatest(functions, -kInf);
      for (std::size_t k = 0; k < corners * functions; ++k) {
        double& most = greatest[k % functions];
        most = std::max(most, values[i * corners * functions + k]);
      }
      if (is_broken(wave[i], greatest)) continue;
      const bool worst = question_.over == Over::worst;
      standing.push_back({wave[i], worst ? std::max(wave[i].objective, greatest[kObjective]) : wave[i].objective});
    }
    return standing;
  }

  /// Counts and remembers the one that was nearest to standing.
  bool is_broken(const Candidate& candidate, const std::vector<double>& greatest) {
    std::size_t most = kStatus;
    for (std::size_t f = kFirstConstraint; f < greatest.size(); ++f)
      if (greatest[f] > trials_.limits()[f] && (most == kStatus || greatest[f] > greatest[most])) most = f;
    const auto holds = [&](std::size_t f) { return greatest[f] <= trials_.limits()[f]; };
    const bool runs = holds(kStability) && holds(kStatus) && holds(kObjective);
    if (runs && most == kStatus) return false;
    ++(runs ? answer_.broken_by[most - kFirstConstraint] : answer_.not_settled);
    if (!runs) return true;
    const double violation = greatest[most];
    if (!nearest_ || violation < nearest_violation_) {
      nearest_ = candidate;
      nearest_violation_ = violation;
    }
    return true;
  }

  /// Those that no node rejects, with the mean.
  std::vector<Standing> with_means(const std::vector<Standing>& standing) {
    std::vector<Setting> settings;
    for (const Standing& one : standing) settings.push_back(setting_of(one.candidate));
    const std::vector<BoxExaminer::Mean> means = examiner_.means(settings, conditions_.threads);
    std::vector<Standing> all;
    for (std::size_t i = 0; i < means.size(); ++i)
      if (means[i].within && !std::isnan(means[i].objective))
        all.push_back({standing[i].candidate, means[i].objective});
    return all;
  }

  void judge(std::span<const Standing> together) {
    std::vector<BoxExaminer::Judged> judged(together.size());
    in_parts(conditions_.threads, together.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) judged[i] = examiner_.judge(setting_of(together[i].candidate));
    });
    for (std::size_t i = 0; i < together.size(); ++i) {
      answer_.loops += judged[i].loops;
      answer_.open += judged[i].outcome == Outcome::open ? 1 : 0;
      if (judged[i].outcome != Outcome::within) continue;
      Candidate candidate = together[i].candidate;
      if (question_.over == Over::worst)
        candidate.objective = std::max(candidate.objective, judged[i].worst_objective);
      if (question_.over == Over::mean) candidate.objective = together[i].least;
      best_.offer(candidate);
    }
  }

  const ColumnSource& source_;
  const RobustQuestion& question_;
  Conditions conditions_;
  PlantTrials trials_;
  BoxExaminer examiner_;
  Ranking best_;
  RobustAnswer answer_;
  std::optional<Candidate> first_, nearest_;
  double nearest_violation_ = kInf;
};

}  // namespace

std::optional<Over> over_named(std::string_view name) {
  const auto found = std::find(kOverNames.begin(), kOverNames.end(), name);
  if (found == kOverNames.end()) return std::nullopt;
  return static_cast<Over>(found - kOverNames.begin());
}

RobustAnswer ask_robust(const ColumnSource& source, const RobustQuestion& question) {
  require_fits(question, source.grid());
  require_answerable(on_nominal(question), source.grid());
  return Search(source, question).run();
}

OverBox examine(const Grid& grid, const RobustQuestion& question, const Setting& setting) {
  require_fits(question, grid);
  const Conditions conditions = on_nominal(question);
  const PlantTrials trials(grid, question.box, question.minimize, conditions);
  return BoxExaminer(grid, question.box, trials).report(setting, conditions.threads);
}

}  // namespace portrait
