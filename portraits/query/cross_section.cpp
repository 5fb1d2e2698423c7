#include "portraits/query/cross_section.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/base/check.h"

namespace portrait {
namespace {

std::vector<std::uint64_t> strides(const Grid& grid) {
  std::vector<std::uint64_t> found(grid.axes.size());
  std::uint64_t stride = 1;
  for (std::size_t k = grid.axes.size(); k-- > 0; stride *= grid.axes[k].size()) found[k] = stride;
  return found;
}

/// Calls use(position, first number, length) for every run of consecutive numbers.
template <typename Use>
void for_each_run(const std::vector<std::uint64_t>& numbers, const std::vector<std::size_t>& ascending, Use use) {
  for (std::size_t begin = 0; begin < ascending.size();) {
    std::size_t end = begin + 1;
    while (end < ascending.size() && numbers[ascending[end]] == numbers[ascending[begin]] + (end - begin)) ++end;
    use(begin, numbers[ascending[begin]], end - begin);
    begin = end;
  }
}

double excess(Relation relation, double left, double right) {
  const double scale = std::max(std::abs(right), kTinyBound);
  switch (relation) {
    case Relation::at_most:
    case Relation::below:
      return (left - right) / scale;
    case Relation::at_least:
    case Relation::above:
      return (right - left) / scale;
    case Relation::equal:
      break;
  }
  return -kInf;
}

}  // namespace

bool has_axis(const Grid& grid, Parameter parameter) {
  return std::any_of(grid.axes.begin(), grid.axes.end(),
                     [&](const Axis& axis) { return axis.parameter() == parameter; });
}

std::size_t axis_index(const Grid& grid, Parameter parameter) {
  const auto found = std::find_if(grid.axes.begin(), grid.axes.end(),
                                  [&](const Axis& axis) { return axis.parameter() == parameter; });
  PORTRAIT_CHECK(found != grid.axes.end());
  return static_cast<std::size_t>(found - grid.axes.begin());
}

CrossSection::CrossSection(const ColumnSource& source, const QueryUnits& units, Parameter x, Parameter y,
                           std::vector<std::uint64_t> held)
    : source_(source), units_(units), parameters_(source.grid()) {
  const Grid& grid = source.grid();
  const std::size_t kx = axis_index(grid, x), ky = axis_index(grid, y);
  PORTRAIT_CHECK(kx != ky);
  PORTRAIT_CHECK_EQ(held.size(), grid.axes.size());
  x_values_ = grid.axes[kx].values();
  y_values_ = grid.axes[ky].values();
  const std::vector<std::uint64_t> stride = strides(grid);
  held[kx] = held[ky] = 0;
  const std::uint64_t origin = std::inner_product(held.begin(), held.end(), stride.begin(), std::uint64_t{0});
  for (std::size_t j = 0; j < ny(); ++j)
    for (std::size_t i = 0; i < nx(); ++i) numbers_.push_back(origin + i * stride[kx] + j * stride[ky]);
  ascending_.resize(numbers_.size());
  std::iota(ascending_.begin(), ascending_.end(), std::size_t{0});
  std::sort(ascending_.begin(), ascending_.end(),
            [&](std::size_t a, std::size_t b) { return numbers_[a] < numbers_[b]; });
  statuses_.resize(numbers_.size());
  std::vector<Status> run;
  for_each_run(numbers_, ascending_, [&](std::size_t at, std::uint64_t first, std::size_t count) {
    source_.read_statuses(first, count, run);
    for (std::size_t k = 0; k < count; ++k) statuses_[ascending_[at + k]] = run[k];
  });
}

void CrossSection::gather(Measure measure, std::vector<double>& values) const {
  std::vector<double> run;
  const double unit = factor(measure, units_);
  for_each_run(numbers_, ascending_, [&](std::size_t at, std::uint64_t first, std::size_t count) {
    source_.read(measure, first, count, run);
    for (std::size_t k = 0; k < count; ++k) values[ascending_[at + k]] = run[k] * unit;
  });
}

void CrossSection::gather(Parameter parameter, std::vector<double>& values) const {
  std::vector<double> run;
  for_each_run(numbers_, ascending_, [&](std::size_t at, std::uint64_t first, std::size_t count) {
    parameters_.read(parameter, first, count, run);
    for (std::size_t k = 0; k < count; ++k) values[ascending_[at + k]] = run[k];
  });
}

void CrossSection::gather(ControllerValue value, std::vector<double>& values) const {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    const Setting setting = setting_at(source_.grid(), numbers_[i]);
    values[i] = controller_value<double>(value, *units_.plant,
                                         [&](Parameter parameter) { return get(setting, parameter); });
  }
}

void CrossSection::gather(Quantity quantity, std::vector<double>& values) const {
  values.resize(numbers_.size());
  std::visit([&](auto one) { gather(one, values); }, quantity);
}

std::vector<double> CrossSection::values(const Expression& expression) const {
  Columns columns;
  columns.count = numbers_.size();
  for (const Expression::Use& use : expression.uses())
    if (columns[use.quantity].empty()) gather(use.quantity, columns[use.quantity]);
  ColumnStack stack;
  std::vector<double> result;
  expression.evaluate(columns, stack, result);
  return result;
}

std::vector<bool> CrossSection::eligible(const Question& question) const {
  const std::vector<double> objective = values(question.minimize);
  std::vector<bool> result(numbers_.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const bool status = statuses_[i] == Status::settled ||
                        (question.conditions.include_not_settled && statuses_[i] == Status::not_settled);
    result[i] = status && !std::isnan(objective[i]);
  }
  return result;
}

std::vector<bool> CrossSection::admissible(const Question& question) const {
  std::vector<bool> result = eligible(question);
  for (const Constraint& constraint : question.conditions.where) {
    const std::vector<double> left = values(constraint.left), right = values(constraint.right);
    for (std::size_t i = 0; i < result.size(); ++i)
      if (!holds(constraint.relation, left[i], right[i])) result[i] = false;
  }
  return result;
}

std::vector<double> CrossSection::violation(const Question& question) const {
  const std::vector<bool> allowed = eligible(question);
  std::vector<double> worst(numbers_.size(), -kInf);
  for (const Constraint& constraint : question.conditions.where) {
    const std::vector<double> left = values(constraint.left), right = values(constraint.right);
    for (std::size_t i = 0; i < worst.size(); ++i) {
      const double by = excess(constraint.relation, left[i], right[i]);
      if (std::isnan(by) || std::isnan(worst[i]))
        worst[i] = kNaN;
      else
        worst[i] = std::max(worst[i], by);
    }
  }
  for (std::size_t i = 0; i < worst.size(); ++i)
    if (!allowed[i]) worst[i] = kNaN;
  return worst;
}

}  // namespace portrait
