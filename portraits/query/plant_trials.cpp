#include "portraits/query/plant_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/loop/noise_gain.h"
#include "engine/sweep/method.h"
#include "portraits/query/workers.h"

namespace portrait {
namespace {

/// A strict relation is kept by this much of its bound.
constexpr double kStrictly = 1e-12;

bool names_a_measure(const Constraint& constraint) {
  std::vector<Quantity> used;
  collect(constraint, used);
  return std::any_of(used.begin(), used.end(), [](Quantity q) { return std::holds_alternative<Measure>(q); });
}

double excess(Relation relation, double left, double right) {
  const double over = relation == Relation::at_most || relation == Relation::below ? left - right : right - left;
  if (std::isnan(over)) return left == right ? 0 : kInf;  // inf - inf, or a missing side
  const double relative = over / std::max(std::abs(right), kTinyBound);
  const bool strict = relation == Relation::below || relation == Relation::above;
  if (std::isnan(relative)) return over > 0 ? kInf : kDeepest;  // inf/inf
  return std::max(kDeepest, relative) + (strict ? kStrictly : 0);
}

}  // namespace

/// Some trials as columns in the question's units.
struct PlantTrials::Ran {
  std::span<const Trial> trials;
  std::vector<Setting> settings;  ///< as each plant sees them
  std::vector<SettingMeasured> found;
  Columns columns;
  mutable ColumnStack stack;

  std::vector<double> evaluate(const Expression& expression) const {
    std::vector<double> values;
    expression.evaluate(columns, stack, values);
    return values;
  }
};

PlantTrials::PlantTrials(const Grid& grid, const PlantBox& box, const Expression& objective,
                         const Conditions& conditions)
    : grid_(grid), box_(box), objective_(objective), conditions_(conditions) {
  collect(objective, used_);
  limits_ = {std::numeric_limits<double>::max(), -std::numeric_limits<double>::min(), 0};
  for (const Constraint& constraint : conditions.where) {
    collect(constraint, used_);
    chooses_.push_back(!names_a_measure(constraint));
    limits_.push_back(0);
  }
  for (const Quantity quantity : used_)
    if (const Measure* measure = std::get_if<Measure>(&quantity)) measures_.push_back(*measure);
  for (const Measure measure : measures_)
    if (is_noisy(measure))
      throw InputError(
          fmt::format("{}: noise is drawn for one plant; over a box of plants ask for noise_gain, which is exact",
                      to_string(measure)));
}

PlantTrials::Ran PlantTrials::run(std::span<const Trial> trials) const {
  Ran ran{trials, {}, std::vector<SettingMeasured>(trials.size()), {}, {}};
  for (const Trial& trial : trials)
    ran.settings.push_back(seen_by(trial.plant, {grid_.family, trial.setting}, box_.nominal));
  measure_settings(method_for(measures_), grid_.family, grid_.horizon,
                   extras_for(measures_, std::nullopt, std::nullopt, grid_.horizon), ran.settings, ran.found);
  ran.columns.count = trials.size();
  for (const Quantity quantity : used_) {
    std::vector<double>& column = ran.columns[quantity];
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const auto nominal = [&](Parameter parameter) { return get(trials[i].setting, parameter); };
      if (const Parameter* parameter = std::get_if<Parameter>(&quantity)) column.push_back(nominal(*parameter));
      if (const ControllerValue* value = std::get_if<ControllerValue>(&quantity))
        column.push_back(controller_value<double>(*value, box_.nominal, nominal));
      const Measure* measure = std::get_if<Measure>(&quantity);
      if (!measure) continue;
      double value = ran.found[i].measures[*measure];
      if (*measure == Measure::noise_gain && grid_.sampling && ran.found[i].status != Status::unstable)
        value = noise_gain({grid_.family, ran.settings[i]}, *grid_.sampling * box_.nominal.Td / trials[i].plant.Td);
      column.push_back(value * factor(*measure, {trials[i].plant, conditions_.units.steps}));
    }
  }
  return ran;
}

std::vector<double> PlantTrials::values_of(const Ran& ran) const {
  std::vector<std::vector<double>> by_function = {ran.evaluate(objective_), {}, {}};
  for (const SettingMeasured& one : ran.found) {
    const bool settled = one.status == Status::settled;
    const bool taken = settled || (one.status == Status::not_settled && conditions_.include_not_settled);
    by_function[kStability].push_back(-1 / one.measures[Measure::Ms]);
    by_function[kStatus].push_back(taken ? -1 : 1);
  }
  for (std::size_t j = 0; j < conditions_.where.size(); ++j) {
    const Constraint& constraint = conditions_.where[j];
    by_function.emplace_back(ran.trials.size(), kDeepest);
    if (chooses_[j]) continue;
    const std::vector<double> left = ran.evaluate(constraint.left), right = ran.evaluate(constraint.right);
    for (std::size_t i = 0; i < left.size(); ++i)
      by_function.back()[i] = excess(constraint.relation, left[i], right[i]);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < ran.trials.size(); ++i)
    for (const std::vector<double>& function : by_function)
      values.push_back(!std::isnan(function[i]) && function[i] > -kInf ? function[i] : kInf);
  return values;
}

std::vector<double> PlantTrials::values(std::span<const Trial> trials, int threads) const {
  std::vector<double> all(trials.size() * functions());
  if (trials.empty()) return all;
  in_parts(threads, trials.size(), kSettingsPerThread, [&](std::size_t begin, std::size_t end) {
    const std::vector<double> part = values_of(run(trials.subspan(begin, end - begin)));
    std::copy(part.begin(), part.end(), all.begin() + static_cast<std::ptrdiff_t>(begin * functions()));
  });
  return all;
}

PlantTrials::Report PlantTrials::report(const Trial& trial) const {
  const Ran ran = run(std::span(&trial, 1));
  Report report{{ran.settings[0], ran.found[0].status, ran.found[0].measures, trial.plant},
                ran.evaluate(objective_)[0],
                {},
                {},
                ran.found[0].measures[Measure::Ms]};
  for (const Measure measure : all_measures())
    report.measured.measures[measure] *= factor(measure, {trial.plant, conditions_.units.steps});
  for (const Constraint& constraint : conditions_.where) {
    report.left.push_back(ran.evaluate(constraint.left)[0]);
    report.right.push_back(ran.evaluate(constraint.right)[0]);
  }
  return report;
}

void require_keepable(const Constraint& constraint) {
  if (constraint.relation == Relation::equal && names_a_measure(constraint))
    fail_at(constraint.typed, 0, "cannot hold for every plant of a box: give it as <= or >=");
}

}  // namespace portrait
