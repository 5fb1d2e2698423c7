/// Recursive descent over the grammar of expression.h; expressions and constraints are built with it.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "portraits/query/expression.h"
#include "portraits/query/tokens.h"

namespace portrait {

/// Reads a text from left to right. Every function throws InputError at the first thing that does not fit.
class Parser {
 public:
  /// REQUIRES: `text` outlives the parser.
  explicit Parser(const QueryText& text) : text_(text), tokens_(tokens(text)) {}

  /// As much as belongs to one expression, up to a token that cannot continue it.
  Expression expression();
  const Token& current() const { return tokens_[at_]; }
  void advance() { ++at_; }
  /// Only the end of the text may follow; `relation_problem` says what is wrong with a relation here.
  void require_end(std::string_view relation_problem) const;
  /// Says why the current token cannot follow a complete expression. `open`: the unclosed "(" around it.
  [[noreturn]] void fail_after_expression(std::string_view relation_problem, const Token* open = nullptr) const;

 private:
  class Level;
  bool take(std::string_view symbol);
  void sum();
  void product();
  void signed_power();
  void power();
  void operand();
  void named();
  void call(const Token& function);
  std::size_t arguments(const Token& function);
  void parenthesised();
  void close(const Token& open);
  [[noreturn]] void fail_at_name(const Token& name) const;
  [[noreturn]] void fail_at_operand() const;

  const QueryText& text_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Program program_;                    ///< of the expression being read
  std::vector<Expression::Use> uses_;  ///< of the expression being read
};

}  // namespace portrait
