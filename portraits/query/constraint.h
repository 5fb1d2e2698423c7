/// A condition on a setting: EXPR <= EXPR, with <=, <, >=, > or ==.
///
/// Two numbers are == when they are the same within 1e-9 relative, so that it picks the value of an axis. The
/// other relations are exact. With NaN on either side a constraint does not hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "portraits/query/expression.h"

namespace portrait {

enum class Relation : std::uint8_t { at_most, below, at_least, above, equal };
inline constexpr std::array<std::string_view, 5> kRelationSymbols = {"<=", "<", ">=", ">", "=="};
constexpr std::string_view to_string(Relation relation) {
  return kRelationSymbols[static_cast<std::size_t>(relation)];
}

struct Constraint {
  QueryText typed;
  Expression left;
  Relation relation;
  Expression right;

  /// As typed.
  const std::string& text() const { return typed.text; }
};

/// Throws InputError with place and caret.
Constraint parse_constraint(const QueryText& text);

/// Throws InputError when a side names something that the question cannot have (see expression.h), or when the
/// constraint is "parameter == number" and the grid has no such value: nothing could ever hold, and the nearest
/// values are named.
void require_available(const Constraint& constraint, const Grid& grid, bool has_plant);

/// Whether a constraint holds over a tile, from the bounds of its sides.
enum class Outlook : std::uint8_t { always, maybe, never };
Outlook outlook(Relation relation, const Interval& left, const Interval& right);

bool holds(Relation relation, double left, double right);

/// Smallest right side that an amount is taken relative to.
inline constexpr double kTinyBound = 1e-12;

/// How far the sides are from meeting, |left - right| / max(|right|, kTinyBound); inf when one side alone is
/// infinite, NaN when a side is NaN.
double distance(double left, double right);

}  // namespace portrait
