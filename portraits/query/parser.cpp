#include "portraits/query/parser.h"

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "engine/base/words.h"
#include "engine/loop/loop.h"

namespace portrait {
namespace {

struct Function {
  std::string_view name;
  std::variant<Unary, Binary> operation;  ///< of two: applied again and again from the left
};
constexpr std::array<Function, 6> kFunctions = {{{"abs", Unary::abs},
                                                 {"min", Binary::min},
                                                 {"max", Binary::max},
                                                 {"sqrt", Unary::sqrt},
                                                 {"log", Unary::log},
                                                 {"exp", Unary::exp}}};

const Function* function_named(std::string_view name) {
  for (const Function& function : kFunctions)
    if (function.name == name) return &function;
  return nullptr;
}

std::vector<std::string_view> function_names() {
  std::vector<std::string_view> names;
  for (const Function& function : kFunctions) names.push_back(function.name);
  return names;
}

bool is_symbol(const Token& token, std::string_view symbol) {
  return token.kind == TokenKind::symbol && token.text == symbol;
}

}  // namespace

/// Counts how deep the descent is; every recursion passes through signed_power.
class Parser::Level {
 public:
  explicit Level(Parser& parser) : parser_(parser) {
    if (++parser_.depth_ > kMaxDepth)
      fail_at(parser_.text_, parser_.current().offset, fmt::format("nested deeper than {} levels", kMaxDepth));
  }
  ~Level() { --parser_.depth_; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

 private:
  Parser& parser_;
};

Expression Parser::expression() {
  program_ = {};
  uses_.clear();
  const std::size_t first = at_;
  sum();
  const Token& last = tokens_[at_ - 1];
  const std::size_t begin = tokens_[first].offset;
  const std::string_view all = text_.text;
  return {text_, all.substr(begin, last.offset + last.text.size() - begin), std::move(program_), std::move(uses_)};
}

void Parser::require_end(std::string_view relation_problem) const {
  if (current().kind != TokenKind::end) fail_after_expression(relation_problem);
}

void Parser::fail_after_expression(std::string_view relation_problem, const Token* open) const {
  const Token& token = current();
  if (open != nullptr && token.kind == TokenKind::end) fail_at(text_, open->offset, "this \"(\" is never closed");
  const std::string_view problem = is_relation(token)      ? relation_problem
                                   : is_symbol(token, ")") ? "has no \"(\""
                                   : is_symbol(token, ",") ? "stands outside a function's arguments"
                                                           : "follows without an operator between";
  fail_at(text_, token.offset, fmt::format("\"{}\" {}", token.text, problem));
}

bool Parser::take(std::string_view symbol) {
  if (!is_symbol(current(), symbol)) return false;
  advance();
  return true;
}

void Parser::sum() {
  product();
  for (;;) {
    const bool plus = is_symbol(current(), "+");
    if (!plus && !is_symbol(current(), "-")) return;
    advance();
    product();
    program_.apply(plus ? Binary::add : Binary::subtract);
  }
}

void Parser::product() {
  signed_power();
  for (;;) {
    const bool times = is_symbol(current(), "*");
    if (!times && !is_symbol(current(), "/")) return;
    advance();
    signed_power();
    program_.apply(times ? Binary::multiply : Binary::divide);
  }
}

void Parser::signed_power() {
  const Level level(*this);
  if (take("+")) return signed_power();
  if (!take("-")) return power();
  signed_power();
  program_.apply(Unary::negate);
}

void Parser::power() {
  operand();
  if (!take("^")) return;
  signed_power();
  program_.apply(Binary::power);
}

void Parser::operand() {
  const Token& token = current();
  if (token.kind == TokenKind::name) return named();
  if (is_symbol(token, "(")) return parenthesised();
  if (token.kind != TokenKind::number) fail_at_operand();
  program_.push(token.number);
  advance();
}

void Parser::named() {
  const Token& name = current();
  advance();
  if (function_named(name.text) != nullptr) return call(name);
  if (name.text == "inf") return program_.push(kInf);
  const std::optional<Quantity> quantity = quantity_named(name.text);
  if (!quantity) fail_at_name(name);
  uses_.push_back({*quantity, name.offset});
  program_.push(*quantity);
}

void Parser::call(const Token& function) {
  const auto& operation = function_named(function.text)->operation;
  if (!is_symbol(current(), "("))
    fail_at(text_, function.offset, fmt::format("\"{0}\" is a function: write {0}(...)", function.text));
  const bool unary = std::holds_alternative<Unary>(operation);
  const std::size_t given = arguments(function);
  if (unary && given != 1)
    fail_at(text_, function.offset, fmt::format("{} takes one argument (it has {})", function.text, given));
  if (!unary && given < 2)
    fail_at(text_, function.offset,
            fmt::format("{} takes two or more arguments (it has {})", function.text, given));
  if (unary) program_.apply(std::get<Unary>(operation));
}

/// Folds the arguments of min and max as they come, so that a long list needs no deep stack.
std::size_t Parser::arguments(const Token& function) {
  const auto& operation = function_named(function.text)->operation;
  const Token& open = current();
  advance();
  if (take(")")) return 0;
  std::size_t count = 0;
  do {
    sum();
    ++count;
    if (count > 1 && std::holds_alternative<Binary>(operation)) program_.apply(std::get<Binary>(operation));
  } while (take(","));
  close(open);
  return count;
}

void Parser::parenthesised() {
  const Token& open = current();
  advance();
  sum();
  close(open);
}

void Parser::close(const Token& open) {
  if (!take(")")) fail_after_expression("stands inside parentheses", &open);
}

void Parser::fail_at_name(const Token& name) const {
  const bool called = is_symbol(current(), "(");
  std::vector<std::string_view> known = called ? function_names() : quantity_names();
  if (!called) known.push_back("inf");
  fail_at(
      text_, name.offset,
      fmt::format("unknown {} \"{}\"{}", called ? "function" : "name", name.text, suggestion(name.text, known)));
}

void Parser::fail_at_operand() const {
  const Token& token = current();
  const std::string found =
      token.kind == TokenKind::end ? "the text ends" : fmt::format("there is \"{}\"", token.text);
  fail_at(text_, token.offset, fmt::format("expected a number, a name or \"(\", but {}", found));
}

}  // namespace portrait
