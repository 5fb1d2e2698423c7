/// Arithmetic over the measures and parameters of a setting, as users write it: IAE_w + 0.5*TV2_uw.
///
///     sum      = product (("+" | "-") product)*
///     product  = signed (("*" | "/") signed)*
///     signed   = ("-" | "+") signed | power
///     power    = operand ["^" signed]            to the right: 2^3^2 = 2^9; above the sign: -2^2 = -4
///     operand  = NUMBER | "inf" | NAME | "(" sum ")" | FUNCTION "(" sum ("," sum)* ")"
///
/// NAME      a measure (engine/measures/catalogue.h), a parameter (engine/loop/parameters.h) or a value of the real
///           controller (ControllerValue)
/// FUNCTION  abs, sqrt, log (natural), exp of one argument; min, max of two or more
/// NaN       in any operand gives NaN
/// limits    kMaxQueryText bytes, kMaxDepth levels, so that no text can exhaust the call stack
/// memory    while it is evaluated at most three columns a level: tests/portraits/query/expression_test.cpp
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "grids/grid.h"
#include "portraits/query/program.h"
#include "portraits/query/query_text.h"

namespace portrait {

/// Signs, parentheses, arguments and exponents that may stand inside each other.
inline constexpr int kMaxDepth = 100;

class Expression {
 public:
  /// Where a quantity is named: byte offset in the whole text.
  struct Use {
    Quantity quantity;
    std::size_t offset;
  };

  /// REQUIRES: the program leaves one value. For the parser.
  Expression(QueryText whole, std::string_view text, Program program, std::vector<Use> uses)
      : whole_(std::move(whole)), text_(text), program_(std::move(program)), uses_(std::move(uses)) {}

  /// As typed, without the space around it.
  const std::string& text() const { return text_; }
  /// The text it was found in, which for a side of a constraint is the constraint's.
  const QueryText& whole() const { return whole_; }
  /// Every place where a quantity is named, from left to right.
  const std::vector<Use>& uses() const { return uses_; }

  /// The value when no quantity is named, else nothing.
  std::optional<double> constant() const;
  /// The quantity when the expression is nothing but its name, else nothing.
  std::optional<Quantity> single_quantity() const { return program_.single_quantity(); }

  /// `values` gets columns.count numbers. REQUIRES: the columns of all quantities in use are filled.
  void evaluate(const Columns& columns, ColumnStack& stack, std::vector<double>& values) const {
    program_.run(columns, stack, values);
  }
  /// Encloses the values when each quantity lies in its interval.
  Interval bound(const std::function<Interval(Quantity)>& of, std::vector<Interval>& stack) const {
    return program_.bound(of, stack);
  }

 private:
  QueryText whole_;
  std::string text_;
  Program program_;
  std::vector<Use> uses_;
};

/// Throws InputError with place, caret and the nearest valid word.
Expression parse_expression(const QueryText& text);

/// Throws InputError when the expression names a measure that the grid does not store, a parameter it does not
/// have, or a value of the controller when there is no real plant to have one for.
void require_available(const Expression& expression, const Grid& grid, bool has_plant);

}  // namespace portrait
