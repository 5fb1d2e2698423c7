#include "portraits/query/query.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/query/query_pass.h"
#include "portraits/query/real_units.h"

namespace portrait {
namespace {

void require_answerable(const Question& question, const Grid& grid) {
  if (question.top < 1 || question.top > kMaxTop)
    throw InputError(fmt::format("top must be 1 .. {} (it is {})", kMaxTop, question.top));
  require_available(question.minimize, grid);
  for (const Constraint& constraint : question.where) require_available(constraint, grid);
  if (question.plant) require_fits(*question.plant, grid);
}

MeasureRow measures_of(const ColumnSource& source, std::uint64_t number) {
  MeasureRow row;
  std::vector<double> value;
  for (const Measure measure : source.grid().measures) {
    source.read(measure, number, 1, value);
    row[measure] = value.at(0);
  }
  return row;
}

Found found(const ColumnSource& source, const Candidate& candidate) {
  return {.number = candidate.number,
          .setting = setting_at(source.grid(), candidate.number),
          .measures = measures_of(source, candidate.number),
          .objective = candidate.objective,
          .status = candidate.status};
}

/// Without the constraint the best is the better of the optimum and the best setting that it alone excludes.
std::vector<ActiveConstraint> active_constraints(const ColumnSource& source, const Tally& tally) {
  std::vector<ActiveConstraint> active;
  const std::vector<Candidate> optimum = tally.best.sorted();
  for (std::size_t j = 0; j < tally.best_without.size(); ++j) {
    const std::vector<Candidate> without = tally.best_without[j].sorted();
    if (without.empty()) continue;
    const bool better = optimum.empty() || without[0].objective < optimum[0].objective;
    if (better) active.push_back({j, found(source, without[0])});
  }
  return active;
}

void explain_nothing(Answer& answer, const ColumnSource& source, const Tally& tally) {
  const auto most = std::max_element(tally.excluded.begin(), tally.excluded.end());
  if (most != tally.excluded.end() && *most > 0)
    answer.strictest = static_cast<std::size_t>(most - tally.excluded.begin());
  if (tally.nearest)
    answer.near_miss = NearMiss{found(source, tally.nearest->candidate), tally.nearest->violations};
}

Answer answer_from(const ColumnSource& source, const Tally& tally) {
  Answer answer;
  answer.admissible = tally.admissible;
  answer.total = tally.total;
  answer.left_out = tally.left_out;
  answer.excluded = tally.excluded;
  for (const Candidate& candidate : tally.best.sorted()) answer.top.push_back(found(source, candidate));
  answer.active = active_constraints(source, tally);
  if (tally.admissible == 0) explain_nothing(answer, source, tally);
  return answer;
}

}  // namespace

Answer ask(const ColumnSource& source, const Question& question) {
  require_answerable(question, source.grid());
  if (!question.plant) return answer_from(source, QueryPass(source, question, std::nullopt).run());
  const RealUnits real(source, *question.plant);
  return answer_from(real, QueryPass(real, question, slice_of(*question.plant, source.grid())).run());
}

}  // namespace portrait
