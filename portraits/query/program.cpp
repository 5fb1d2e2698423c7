#include "portraits/query/program.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"
#include "engine/loop/loop.h"

namespace portrait {
namespace {

using Column = std::vector<double>;

template <typename Function>
void each(Column& x, Function function) {
  for (double& value : x) value = function(value);
}

/// Left operand and result share their place.
template <typename Function>
void each(Column& left, const Column& right, Function function) {
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = function(left[i], right[i]);
}

double smaller(double a, double b) { return std::isnan(b) || b < a ? b : a; }
double larger(double a, double b) { return std::isnan(b) || b > a ? b : a; }
double power(double a, double b) { return std::isnan(a) || std::isnan(b) ? kNaN : std::pow(a, b); }

void work(Unary operation, Column& x) {
  switch (operation) {
    case Unary::negate:
      return each(x, [](double a) { return -a; });
    case Unary::abs:
      return each(x, [](double a) { return std::abs(a); });
    case Unary::sqrt:
      return each(x, [](double a) { return std::sqrt(a); });
    case Unary::log:
      return each(x, [](double a) { return std::log(a); });
    case Unary::exp:
      return each(x, [](double a) { return std::exp(a); });
  }
}

void work(Binary operation, Column& x, const Column& y) {
  switch (operation) {
    case Binary::add:
      return each(x, y, [](double a, double b) { return a + b; });
    case Binary::subtract:
      return each(x, y, [](double a, double b) { return a - b; });
    case Binary::multiply:
      return each(x, y, [](double a, double b) { return a * b; });
    case Binary::divide:
      return each(x, y, [](double a, double b) { return a / b; });
    case Binary::power:
      return each(x, y, power);
    case Binary::min:
      return each(x, y, smaller);
    case Binary::max:
      return each(x, y, larger);
  }
}

/// One run of a program: the stack and its height.
struct Run {
  const Columns& columns;
  ColumnStack& stack;
  std::size_t height = 0;

  void operator()(double number) { stack[height++].assign(columns.count, number); }
  void operator()(Quantity quantity) {
    PORTRAIT_ASSERT(columns[quantity].size() == columns.count);
    stack[height++] = columns[quantity];
  }
  void operator()(Unary operation) { work(operation, stack[height - 1]); }
  void operator()(Binary operation) {
    --height;
    work(operation, stack[height - 1], stack[height]);
  }
};

/// The same over intervals.
struct BoundRun {
  const std::function<Interval(Quantity)>& of;
  std::vector<Interval>& stack;
  std::size_t height = 0;

  void operator()(double number) { stack[height++] = Interval::of(number); }
  void operator()(Quantity quantity) { stack[height++] = of(quantity); }
  void operator()(Unary operation) { stack[height - 1] = worked(operation, stack[height - 1]); }
  void operator()(Binary operation) {
    --height;
    stack[height - 1] = worked(operation, stack[height - 1], stack[height]);
  }

  static Interval worked(Unary operation, const Interval& x) {
    switch (operation) {
      case Unary::negate:
        return -x;
      case Unary::abs:
        return abs(x);
      case Unary::sqrt:
        return sqrt(x);
      case Unary::log:
        return log(x);
      case Unary::exp:
        return exp(x);
    }
    return {};
  }

  static Interval worked(Binary operation, const Interval& x, const Interval& y) {
    switch (operation) {
      case Binary::add:
        return x + y;
      case Binary::subtract:
        return x - y;
      case Binary::multiply:
        return x * y;
      case Binary::divide:
        return x / y;
      case Binary::power:
        return raised(x, y);
      case Binary::min:
        return smaller(x, y);
      case Binary::max:
        return larger(x, y);
    }
    return {};
  }
};

}  // namespace

void Program::grow() { max_height_ = std::max(max_height_, ++height_); }

void Program::push(double number) {
  steps_.emplace_back(number);
  grow();
}

void Program::push(Quantity quantity) {
  steps_.emplace_back(quantity);
  grow();
}

void Program::apply(Unary operation) {
  PORTRAIT_CHECK(height_ >= 1);
  steps_.emplace_back(operation);
}

void Program::apply(Binary operation) {
  PORTRAIT_CHECK(height_ >= 2);
  steps_.emplace_back(operation);
  --height_;
}

std::optional<Quantity> Program::single_quantity() const {
  if (steps_.size() != 1 || !std::holds_alternative<Quantity>(steps_[0])) return std::nullopt;
  return std::get<Quantity>(steps_[0]);
}

bool Program::is_constant() const {
  return std::none_of(steps_.begin(), steps_.end(),
                      [](const Step& step) { return std::holds_alternative<Quantity>(step); });
}

void Program::run(const Columns& columns, ColumnStack& stack, std::vector<double>& result) const {
  PORTRAIT_CHECK_EQ(height_, std::size_t{1});
  if (stack.size() < max_height_) stack.resize(max_height_);
  Run run{columns, stack};
  for (const Step& step : steps_) std::visit(run, step);
  result.assign(stack[0].begin(), stack[0].end());
}

Interval Program::bound(const std::function<Interval(Quantity)>& of, std::vector<Interval>& stack) const {
  PORTRAIT_CHECK_EQ(height_, std::size_t{1});
  if (stack.size() < max_height_) stack.resize(max_height_);
  BoundRun run{of, stack};
  for (const Step& step : steps_) std::visit(run, step);
  return stack[0];
}

}  // namespace portrait
