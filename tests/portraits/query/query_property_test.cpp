/// Queries over random portraits against a plain loop that follows the definitions word by word.
#include <cmath>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "engine/base/error.h"
#include "portraits/query/query.h"
#include "tests/portraits/query/expression_tree.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/random_question.h"

namespace portrait {
namespace {

struct Judged {
  std::uint64_t number;
  double objective;
  std::vector<std::size_t> violated;
  double worst;  ///< NaN: cannot be said
};

/// All settings of the slice by the definitions, one at a time.
struct Plain {
  std::vector<Judged> eligible;
  Answer counts;
};

/// Every measure drawn here grows in proportion to the step.
double unit_of(Measure measure, const QueryUnits& units) {
  const double step = info(measure).step == 'w' ? units.steps.w : units.steps.d;
  return (units.plant ? scale(measure, *units.plant) : 1) * step;
}

/// As controller_for has it, in its own order of operations.
double plain_controller(ControllerValue value, const Setting& setting, const RealPlant& plant) {
  const double g = input_gain(plant), Kc = setting.kappa / g;
  const double values[] = {Kc,
                           setting.tau_i * plant.Td,
                           tau_d(setting) * plant.Td,
                           Kc / (setting.tau_i * plant.Td),
                           setting.delta * plant.Td / g,
                           setting.tau_f * plant.Td};
  return values[static_cast<std::size_t>(value)];
}

double looked_up(const MemorySource& source, const Question& question, std::uint64_t number, Quantity quantity) {
  if (const Measure* measure = std::get_if<Measure>(&quantity))
    return source.at(*measure, number) * unit_of(*measure, question.conditions.units);
  if (const ControllerValue* value = std::get_if<ControllerValue>(&quantity))
    return plain_controller(*value, setting_at(source.grid(), number), *question.conditions.units.plant);
  const std::vector<std::uint64_t> at = coordinates(source.grid(), number);
  for (std::size_t k = 0; k < at.size(); ++k)
    if (source.grid().axes[k].parameter() == std::get<Parameter>(quantity)) return source.grid().axes[k][at[k]];
  return get(setting_at(source.grid(), number), std::get<Parameter>(quantity));
}

bool plainly_holds(Relation relation, double l, double r) {
  const bool near = l == r || (std::isfinite(l) && std::isfinite(r) &&
                               std::abs(l - r) <= 1e-9 * std::max(std::abs(l), std::abs(r)));
  const bool answers[] = {l <= r, l<r, l >= r, l> r, near};
  return answers[static_cast<std::size_t>(relation)];
}

Judged judged(const Case& one, const Lookup& lookup, std::uint64_t number) {
  Judged result{number, value_of(one.objective, lookup), {}, 0};
  for (std::size_t j = 0; j < one.where.size(); ++j) {
    const double l = value_of(one.where[j].left, lookup), r = value_of(one.where[j].right, lookup);
    if (plainly_holds(one.where[j].relation, l, r)) continue;
    result.violated.push_back(j);
    const double amount = l == r                           ? 0
                          : std::isinf(l) || std::isinf(r) ? kInf
                                                           : std::abs(l - r) / std::max(std::abs(r), 1e-12);
    result.worst =
        std::isnan(l) || std::isnan(r) || std::isnan(result.worst) ? kNaN : std::max(result.worst, amount);
  }
  return result;
}

Plain plain_loop(const MemorySource& source, const Case& one) {
  const Question& q = one.question;
  Plain plain;
  LeftOut& out = plain.counts.left_out;
  for (std::uint64_t i = 0; i < setting_count(source.grid()); ++i) {
    const double tau_1 = setting_at(source.grid(), i).tau_1;
    const auto& plant = q.conditions.units.plant;
    if (plant && plant->family == Plant::fotd && std::abs(tau_1 - plant->T1 / plant->Td) > 1e-6) continue;
    ++plain.counts.total;
    const Status status = source.status(i);
    if (status == Status::unstable) ++out.unstable;
    if (status == Status::not_computed) ++out.not_computed;
    if (status == Status::not_settled && !q.conditions.include_not_settled) ++out.not_settled;
    if (status != Status::settled && !(status == Status::not_settled && q.conditions.include_not_settled)) continue;
    const Judged result = judged(
        one, [&](Quantity name) { return looked_up(source, q, i, name); }, i);
    if (std::isnan(result.objective) && result.violated.empty()) ++out.objective_missing;
    plain.eligible.push_back(result);
  }
  return plain;
}

/// Best first, of those that fail nothing, or nothing but `forgiven`.
std::vector<Judged> sorted_without(const Plain& plain, std::optional<std::size_t> forgiven) {
  std::vector<Judged> kept;
  for (const Judged& one : plain.eligible)
    if (!std::isnan(one.objective) &&
        std::all_of(one.violated.begin(), one.violated.end(), [&](std::size_t j) { return j == forgiven; }))
      kept.push_back(one);
  std::stable_sort(kept.begin(), kept.end(), [](auto& a, auto& b) { return a.objective < b.objective; });
  return kept;
}

void check_counts(const Answer& answer, const Plain& plain, std::size_t constraints) {
  RC_ASSERT(answer.total == plain.counts.total);
  RC_ASSERT(answer.left_out.unstable == plain.counts.left_out.unstable);
  RC_ASSERT(answer.left_out.not_settled == plain.counts.left_out.not_settled);
  RC_ASSERT(answer.left_out.not_computed == plain.counts.left_out.not_computed);
  RC_ASSERT(answer.left_out.objective_missing == plain.counts.left_out.objective_missing);
  RC_ASSERT(answer.excluded.size() == constraints || answer.excluded.empty());
  for (std::size_t j = 0; j < answer.excluded.size(); ++j)
    RC_ASSERT(answer.excluded[j] == static_cast<std::uint64_t>(
                                        std::count_if(plain.eligible.begin(), plain.eligible.end(), [&](auto& one) {
                                          return std::count(one.violated.begin(), one.violated.end(), j) > 0;
                                        })));
}

void check_top(const Answer& answer, const std::vector<Judged>& admissible, const Case& one,
               const MemorySource& source) {
  RC_ASSERT(answer.admissible == admissible.size());
  RC_ASSERT(answer.top.size() == std::min(admissible.size(), one.question.top));
  for (std::size_t k = 0; k < answer.top.size(); ++k) {
    const Found& found = answer.top[k];
    RC_ASSERT(found.number == admissible[k].number);
    RC_ASSERT(found.objective == admissible[k].objective);
    RC_ASSERT(found.status == source.status(found.number));
    for (const Measure measure : source.grid().measures)
      RC_ASSERT(identical(found.measures[measure], looked_up(source, one.question, found.number, measure)));
    RC_ASSERT(setting_text({source.grid().family, found.setting}) ==
              setting_text({source.grid().family, setting_at(source.grid(), found.number)}));
  }
}

/// Of the settings that fail this constraint alone and are better than the optimum, the one that fails by least.
void check_loosened(const ActiveConstraint& active, const std::vector<Judged>& without,
                    const std::vector<Judged>& admissible) {
  const Judged* least = nullptr;
  for (const Judged& one : without) {
    const bool is_better = !one.violated.empty() && (admissible.empty() || one.objective < admissible[0].objective);
    if (!is_better || std::isnan(one.worst)) continue;
    if (least == nullptr || one.worst < least->worst) least = &one;  // sorted: the better one came first
  }
  RC_ASSERT(active.loosened.has_value() == (least != nullptr));
  if (least == nullptr) return;
  RC_ASSERT(active.loosened->found.number == least->number);
  RC_ASSERT(active.loosened->relative == least->worst);
}

void check_active(const Answer& answer, const Plain& plain, const std::vector<Judged>& admissible,
                  std::size_t constraints) {
  std::size_t next = 0;
  for (std::size_t j = 0; j < constraints; ++j) {
    const std::vector<Judged> without = sorted_without(plain, j);
    const bool better = !without.empty() && (admissible.empty() || without[0].objective < admissible[0].objective);
    if (!better) continue;
    RC_ASSERT(next < answer.active.size());
    RC_ASSERT(answer.active[next].constraint == j);
    RC_ASSERT(answer.active[next].optimum.number == without[0].number);
    RC_ASSERT(answer.active[next].optimum.objective == without[0].objective);
    check_loosened(answer.active[next], without, admissible);
    ++next;
  }
  RC_ASSERT(answer.active.size() == next);
}

void check_strictest(const Answer& answer) {
  std::optional<std::size_t> strictest;
  for (std::size_t j = 0; j < answer.excluded.size(); ++j)
    if (answer.excluded[j] > (strictest ? answer.excluded[*strictest] : 0)) strictest = j;
  RC_ASSERT(answer.strictest == strictest);
}

void check_near_miss(const Answer& answer, const Plain& plain) {
  const Judged* nearest = nullptr;
  for (const Judged& one : plain.eligible)
    if (!std::isnan(one.objective) && !std::isnan(one.worst) && (nearest == nullptr || one.worst < nearest->worst))
      nearest = &one;
  RC_ASSERT(answer.near_miss.has_value() == (nearest != nullptr));
  if (nearest == nullptr) return;
  RC_ASSERT(answer.near_miss->found.number == nearest->number);
  RC_ASSERT(answer.near_miss->violations.size() == nearest->violated.size());
  double worst = 0;
  for (std::size_t k = 0; k < nearest->violated.size(); ++k) {
    RC_ASSERT(answer.near_miss->violations[k].constraint == nearest->violated[k]);
    worst = std::max(worst, answer.near_miss->violations[k].relative);
  }
  RC_ASSERT(worst == nearest->worst);
}

RC_GTEST_PROP(QueryProperty, answers_as_a_plain_loop_does, ()) {
  const MemorySource source = random_source(random_grid());
  const Case one = random_case(source.grid());
  const std::size_t constraints = one.where.size();
  RC_LOG() << "minimize " << print(one.objective) << "\n";
  for (const Constraint& constraint : one.question.conditions.where)
    RC_LOG() << "where " << constraint.text() << "\n";
  bool fits = true;  // a random "parameter == number" may name no grid value
  try {
    for (const Constraint& constraint : one.question.conditions.where)
      require_available(constraint, source.grid(), one.question.conditions.units.plant.has_value());
  } catch (const InputError&) {
    fits = false;
  }
  RC_PRE(fits);
  const Answer answer = ask(source, one.question);
  const Plain plain = plain_loop(source, one);
  const std::vector<Judged> admissible = sorted_without(plain, std::nullopt);
  RC_CLASSIFY(admissible.empty(), "nothing admissible");
  RC_CLASSIFY(!answer.active.empty(), "active constraints");
  RC_CLASSIFY(one.question.conditions.units.plant.has_value(), "with a plant");
  check_counts(answer, plain, constraints);
  RC_ASSERT(answer.excluded.empty() == (constraints == 0 || (!one.question.count_excluded && !admissible.empty())));
  check_top(answer, admissible, one, source);
  check_active(answer, plain, admissible, constraints);
  if (admissible.empty()) {
    check_near_miss(answer, plain);
    check_strictest(answer);
  }
  RC_ASSERT(admissible.empty() || (!answer.near_miss && !answer.strictest));
}

}  // namespace
}  // namespace portrait
