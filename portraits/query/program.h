/// An expression as a postfix program over whole columns: each step works on a block of settings at once.
///
/// NaN in any operand gives NaN, also where the C library thinks otherwise (min, max, 1^x, x^0).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "portraits/query/columns.h"
#include "portraits/query/interval.h"

namespace portrait {

enum class Unary : std::uint8_t { negate, abs, sqrt, log, exp };
enum class Binary : std::uint8_t { add, subtract, multiply, divide, power, min, max };

/// What a program works on, kept between blocks so that memory is taken once.
using ColumnStack = std::vector<std::vector<double>>;

class Program {
 public:
  void push(double number);
  void push(Quantity quantity);
  void apply(Unary operation);
  void apply(Binary operation);

  /// The quantity when the program is nothing but one, else nothing.
  std::optional<Quantity> single_quantity() const;
  /// Whether no quantity occurs.
  bool is_constant() const;

  /// `result` gets columns.count values. REQUIRES: exactly one value is left at the end, and the columns of
  /// all quantities are filled.
  void run(const Columns& columns, ColumnStack& stack, std::vector<double>& result) const;

  /// Encloses every value that `run` can give when each quantity lies in its interval. REQUIRES: as run.
  Interval bound(const std::function<Interval(Quantity)>& of, std::vector<Interval>& stack) const;

 private:
  using Step = std::variant<double, Quantity, Unary, Binary>;
  void grow();
  std::vector<Step> steps_;
  std::size_t height_ = 0;  ///< values on the stack after the last step
  std::size_t max_height_ = 0;
};

}  // namespace portrait
