#include "portraits/query/refine.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "portraits/query/grid_values.h"
#include "portraits/query/minimiser.h"

namespace portrait {
namespace {

/// A strict relation is kept by this much of its bound.
constexpr double kStrictly = 1e-12;

std::optional<Parameter> fixed_by(const Constraint& constraint) {
  if (constraint.relation != Relation::equal) return std::nullopt;
  const auto named = [](const Expression& name, const Expression& number) -> std::optional<Parameter> {
    const auto quantity = name.single_quantity();
    if (!quantity || !number.constant() || !std::holds_alternative<Parameter>(*quantity)) return std::nullopt;
    return std::get<Parameter>(*quantity);
  };
  if (const auto parameter = named(constraint.left, constraint.right)) return parameter;
  return named(constraint.right, constraint.left);
}

/// An axis that may move, in units of the grid's step around the start.
struct Free {
  Parameter parameter;
  double start, step, low, high;
};

double last_finite(const Axis& axis) {
  const double last = axis[axis.size() - 1];
  return std::isfinite(last) || axis.size() < 2 ? last : axis[axis.size() - 2];
}

std::optional<Free> free_axis(const Axis& axis, const Setting& from) {
  const double low = axis[0], high = last_finite(axis), start = get(from, axis.parameter());
  if (!std::isfinite(start) || !(low < high)) return std::nullopt;
  const std::vector<double> values = axis.values();
  std::size_t above = 1;
  while (values[above] < start && std::isfinite(values[above + 1 < values.size() ? above + 1 : above]) &&
         above + 1 < values.size())
    ++above;
  return Free{axis.parameter(), start, values[above] - values[above - 1], low, high};
}

class Refinement {
 public:
  Refinement(const Grid& grid, const Expression& minimize, const Conditions& conditions, const Setting& from)
      : grid_(grid), minimize_(minimize), conditions_(conditions), from_(from) {
    std::vector<Parameter> fixed;
    for (const Constraint& constraint : conditions.where) {
      const auto parameter = fixed_by(constraint);
      if (constraint.relation == Relation::equal && !parameter)
        fail_at(constraint.typed, 0, "leaves nothing to refine: give it as <= or >=");
      if (parameter) fixed.push_back(*parameter);
    }
    if (conditions.units.plant)
      fixed.push_back(lag_parameter(conditions.units.plant->family).value_or(Parameter::tau_1));
    for (const Axis& axis : grid.axes) {
      if (std::find(fixed.begin(), fixed.end(), axis.parameter()) != fixed.end()) continue;
      if (const auto free = free_axis(axis, from)) free_.push_back(*free);
    }
  }

  Refined run() const {
    Refined refined;
    refined.start = measured({from_}).front();
    refined.start_objective = value_at(minimize_, refined.start);
    refined.best = refined.start;
    refined.converged = free_.empty();
    if (!free_.empty()) descend(refined);
    refined.objective = value_at(minimize_, refined.best);
    for (const Constraint& constraint : conditions_.where) {
      refined.left.push_back(value_at(constraint.left, refined.best));
      refined.right.push_back(value_at(constraint.right, refined.best));
    }
    return refined;
  }

 private:
  Setting setting_at_point(const std::vector<double>& point) const {
    Setting setting = from_;
    const double tau_d_before = tau_d(from_);
    bool derivative_moves = false;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const Free& f = free_[k];
      const double value = std::clamp(f.start + f.step * point[k], f.low, f.high);
      if (f.parameter == Parameter::tau_d || f.parameter == Parameter::delta) derivative_moves = true;
      if (f.parameter != Parameter::tau_d) set(setting, f.parameter, value);
    }
    // tau_d last, since it needs kappa; where the grid gives tau_d it stays when kappa moves.
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (free_[k].parameter == Parameter::tau_d)
        set(setting, Parameter::tau_d,
            std::clamp(free_[k].start + free_[k].step * point[k], free_[k].low, free_[k].high));
    if (!derivative_moves && gives_tau_d()) set(setting, Parameter::tau_d, tau_d_before);
    return setting;
  }

  bool gives_tau_d() const {
    const auto is_tau_d = [](const auto& one) { return one == Parameter::tau_d; };
    for (const Axis& axis : grid_.axes)
      if (is_tau_d(axis.parameter())) return true;
    for (const FixedParameter& fixed : grid_.fixed)
      if (is_tau_d(fixed.parameter)) return true;
    return false;
  }

  std::vector<Measured> measured(const std::vector<Setting>& settings) const {
    return measure(grid_, conditions_.units, settings, conditions_.threads);
  }

  bool has_right_status(Status status) const {
    return status == Status::settled || (conditions_.include_not_settled && status == Status::not_settled);
  }

  /// Divided by what the bound is at the start, so that constraints are of one size.
  double excess(std::size_t j, const Measured& at) const {
    const Constraint& constraint = conditions_.where[j];
    const double left = value_at(constraint.left, at), right = value_at(constraint.right, at);
    const bool rises = constraint.relation == Relation::at_most || constraint.relation == Relation::below;
    const bool strict = constraint.relation == Relation::below || constraint.relation == Relation::above;
    return (rises ? left - right : right - left) / scales_[j] + (strict ? kStrictly : 0);
  }

  Probe probe_of(const Measured& at) const {
    Probe probe{kInf, std::vector<double>(inequalities_.size(), kInf)};
    if (!has_right_status(at.status)) return probe;
    probe.objective = value_at(minimize_, at);
    if (std::isnan(probe.objective)) probe.objective = kInf;
    for (std::size_t k = 0; k < inequalities_.size(); ++k) probe.constraints[k] = excess(inequalities_[k], at);
    return probe;
  }

  MinimiserProblem problem() const {
    MinimiserProblem p;
    p.probe = [this](const std::vector<std::vector<double>>& points) {
      std::vector<Setting> settings;
      for (const auto& point : points) settings.push_back(setting_at_point(point));
      std::vector<Probe> probes;
      for (const Measured& at : measured(settings)) probes.push_back(probe_of(at));
      return probes;
    };
    for (const Free& f : free_) {
      p.low.push_back((f.low - f.start) / f.step);
      p.high.push_back((f.high - f.start) / f.step);
      p.start.push_back(0);
    }
    return p;
  }

  void descend(Refined& refined) const {
    scales_.clear();
    inequalities_.clear();
    for (std::size_t j = 0; j < conditions_.where.size(); ++j) {
      scales_.push_back(std::max(std::abs(value_at(conditions_.where[j].right, refined.start)), kTinyBound));
      if (conditions_.where[j].relation != Relation::equal) inequalities_.push_back(j);
    }
    const Minimum minimum = minimise(problem());
    const Setting best = setting_at_point(minimum.point);
    refined.best = measured({best}).front();
    refined.converged = minimum.converged;
    refined.settings_measured = minimum.probes;
    refined.prices.assign(conditions_.where.size(), 0);
    for (std::size_t k = 0; k < inequalities_.size() && k < minimum.prices.size(); ++k)
      refined.prices[inequalities_[k]] = minimum.prices[k] / scales_[inequalities_[k]];
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const Free& f = free_[k];
      refined.moved.push_back(f.parameter);
      const double value = f.start + f.step * minimum.point[k];
      if (value <= f.low + 1e-6 * f.step || value >= f.high - 1e-6 * f.step) refined.at_edge.push_back(f.parameter);
    }
  }

  const Grid& grid_;
  const Expression& minimize_;
  const Conditions& conditions_;
  Setting from_;
  std::vector<Free> free_;
  mutable std::vector<double> scales_;             ///< by constraint
  mutable std::vector<std::size_t> inequalities_;  ///< constraints that limit the move
};

}  // namespace

double Refined::gain() const {
  return (start_objective - objective) / std::max(std::abs(start_objective), kTinyBound);
}

Refined refine(const Grid& grid, const Expression& minimize, const Conditions& conditions, const Setting& from) {
  return Refinement(grid, minimize, conditions, from).run();
}

std::vector<Parameter> edges_at(const Grid& grid, const Setting& setting) {
  std::vector<Parameter> edges;
  for (const Axis& axis : grid.axes) {
    if (axis.size() < 2) continue;
    const double value = get(setting, axis.parameter()), last = axis[axis.size() - 1];
    if (same_number(value, axis[0]) || (std::isfinite(last) && same_number(value, last)))
      edges.push_back(axis.parameter());
  }
  return edges;
}

}  // namespace portrait
