#include "portraits/query/expression.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "portraits/query/parser.h"

namespace portrait {
namespace {

std::string names(const std::vector<Measure>& measures) {
  std::vector<std::string_view> words;
  for (const Measure measure : measures) words.push_back(to_string(measure));
  return words.empty() ? "none" : joined(words);
}

std::string names(const std::vector<Parameter>& parameters) {
  std::vector<std::string_view> words;
  for (const Parameter parameter : parameters) words.push_back(to_string(parameter));
  return joined(words);
}

std::optional<std::string> why_unavailable(Measure measure, const Grid& grid, bool) {
  const bool stored = std::find(grid.measures.begin(), grid.measures.end(), measure) != grid.measures.end();
  if (stored) return std::nullopt;
  return fmt::format("measure \"{}\" is not stored in this portrait (stored: {})", to_string(measure),
                     names(grid.measures));
}

std::optional<std::string> why_unavailable(Parameter parameter, const Grid& grid, bool) {
  if (applies(parameter, grid.family)) return std::nullopt;
  return fmt::format("this portrait has no parameter \"{}\" (it has: {})", to_string(parameter),
                     names(parameters_of(grid.family)));
}

std::optional<std::string> why_unavailable(ControllerValue value, const Grid& grid, bool has_plant) {
  if (!has_plant)
    return fmt::format("{} is in the units of a real plant: say which, with --plant K=..,Td=..", to_string(value));
  if (has_gains(grid.family))
    return fmt::format("{} is of a PID controller; this portrait has gains: {}", to_string(value),
                       names(parameters_of(grid.family)));
  if (value == ControllerValue::Tf && !applies(Parameter::tau_f, grid.family))
    return "this portrait has no filter, so there is no Tf";
  return std::nullopt;
}

}  // namespace

std::optional<double> Expression::constant() const {
  if (!program_.is_constant()) return std::nullopt;
  Columns one;
  one.count = 1;
  ColumnStack stack;
  std::vector<double> value;
  evaluate(one, stack, value);
  return value[0];
}

Expression parse_expression(const QueryText& text) {
  Parser parser(text);
  Expression parsed = parser.expression();
  parser.require_end("makes a constraint; an expression has no relation");
  return parsed;
}

void require_available(const Expression& expression, const Grid& grid, bool has_plant) {
  for (const Expression::Use& use : expression.uses()) {
    const auto why =
        std::visit([&](auto quantity) { return why_unavailable(quantity, grid, has_plant); }, use.quantity);
    if (why) fail_at(expression.whole(), use.offset, *why);
  }
}

}  // namespace portrait
