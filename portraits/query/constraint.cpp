#include "portraits/query/constraint.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "portraits/query/grid_values.h"
#include "portraits/query/parser.h"

namespace portrait {
namespace {

Relation take_relation(Parser& parser, const QueryText& text) {
  const Token& token = parser.current();
  if (token.kind == TokenKind::end)
    fail_at(text, token.offset,
            fmt::format("expected one of {}, but the text ends",
                        joined({kRelationSymbols.begin(), kRelationSymbols.end()})));
  if (!is_relation(token)) parser.fail_after_expression({});
  parser.advance();
  const auto found = std::find(kRelationSymbols.begin(), kRelationSymbols.end(), token.text);
  return static_cast<Relation>(found - kRelationSymbols.begin());
}

const Axis* axis_of(const Grid& grid, Parameter parameter) {
  for (const Axis& axis : grid.axes)
    if (axis.parameter() == parameter) return &axis;
  return nullptr;
}

std::optional<double> fixed_value(const Grid& grid, Parameter parameter) {
  for (const FixedParameter& fixed : grid.fixed)
    if (fixed.parameter == parameter) return fixed.value;
  return std::nullopt;
}

/// Why no setting of the grid can have this value, or nothing when one can or when it is computed.
std::optional<std::string> why_never(const Grid& grid, Parameter parameter, double wanted) {
  if (const Axis* axis = axis_of(grid, parameter)) {
    const std::vector<double> values = axis->values();
    if (index_of_value(values, wanted)) return std::nullopt;
    return fmt::format("the axis {} has no value {} (nearest: {})", axis->name(), number_text(wanted),
                       nearest_values(values, wanted));
  }
  const std::optional<double> fixed = fixed_value(grid, parameter);
  if (!fixed || same_number(*fixed, wanted)) return std::nullopt;
  return fmt::format("{} is {} in the whole portrait, never {}", to_string(parameter), number_text(*fixed),
                     number_text(wanted));
}

void require_value_in_grid(const Expression& name, const Expression& number, const Grid& grid) {
  const std::optional<Quantity> quantity = name.single_quantity();
  const std::optional<double> wanted = number.constant();
  if (!quantity || !wanted || !std::holds_alternative<Parameter>(*quantity)) return;
  const auto why = why_never(grid, std::get<Parameter>(*quantity), *wanted);
  if (why) fail_at(name.whole(), name.uses()[0].offset, *why);
}

}  // namespace

Constraint parse_constraint(const QueryText& text) {
  Parser parser(text);
  Expression left = parser.expression();
  const Relation relation = take_relation(parser, text);
  Expression right = parser.expression();
  parser.require_end("is a second relation; write it as a constraint of its own");
  return {text, std::move(left), relation, std::move(right)};
}

void require_available(const Constraint& constraint, const Grid& grid, bool has_plant) {
  require_available(constraint.left, grid, has_plant);
  require_available(constraint.right, grid, has_plant);
  if (constraint.relation != Relation::equal) return;
  require_value_in_grid(constraint.left, constraint.right, grid);
  require_value_in_grid(constraint.right, constraint.left, grid);
}

bool holds(Relation relation, double left, double right) {
  switch (relation) {
    case Relation::at_most:
      return left <= right;
    case Relation::below:
      return left < right;
    case Relation::at_least:
      return left >= right;
    case Relation::above:
      return left > right;
    case Relation::equal:
      return same_number(left, right);
  }
  return false;
}

Outlook outlook(Relation relation, const Interval& left, const Interval& right) {
  if (!left.has_numbers() || !right.has_numbers()) return Outlook::never;
  const bool sure = !left.may_be_nan && !right.may_be_nan;
  const auto decide = [&](bool always, bool never) {
    return never ? Outlook::never : always && sure ? Outlook::always : Outlook::maybe;
  };
  switch (relation) {
    case Relation::at_most:
      return decide(left.high <= right.low, left.low > right.high);
    case Relation::below:
      return decide(left.high < right.low, left.low >= right.high);
    case Relation::at_least:
      return decide(left.low >= right.high, left.high < right.low);
    case Relation::above:
      return decide(left.low > right.high, left.high <= right.low);
    case Relation::equal:
      break;
  }
  // Apart by more than any two numbers of these sizes that are the same.
  const double gap = std::max(left.low - right.high, right.low - left.high);
  const double size =
      std::max({std::abs(left.low), std::abs(left.high), std::abs(right.low), std::abs(right.high)});
  const bool points = left.low == left.high && right.low == right.high;
  return decide(points && same_number(left.low, right.low), gap > 2 * kSameWithin * size);
}

double distance(double left, double right) {
  if (left == right) return 0;
  if (std::isinf(left) || std::isinf(right)) return std::isnan(left) || std::isnan(right) ? kNaN : kInf;
  return std::abs(left - right) / std::max(std::abs(right), kTinyBound);
}

}  // namespace portrait
