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

void require_available(const Constraint& constraint, const Grid& grid) {
  require_available(constraint.left, grid);
  require_available(constraint.right, grid);
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

double distance(double left, double right) {
  if (left == right) return 0;
  if (std::isinf(left) || std::isinf(right)) return std::isnan(left) || std::isnan(right) ? kNaN : kInf;
  return std::abs(left - right) / std::max(std::abs(right), kTinyBound);
}

}  // namespace portrait
