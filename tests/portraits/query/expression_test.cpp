#include "portraits/query/expression.h"

#include <cmath>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/portraits/query/error_text.h"
#include "tests/portraits/query/expression_tree.h"

namespace portrait {
namespace {

Expression parsed(const std::string& text) { return parse_expression({"--minimize", text}); }

double constant(const std::string& text) { return parsed(text).constant().value(); }

std::vector<double> evaluated(const Expression& expression, const Columns& columns) {
  ColumnStack stack;
  std::vector<double> values;
  expression.evaluate(columns, stack, values);
  return values;
}

std::string problem(const std::string& text) {
  return error_text([&] { parsed(text); });
}

struct Value {
  std::string text;
  double value;
};

TEST(Expression, gives_the_values_of_arithmetic) {
  const std::vector<Value> table = {
      {"1", 1},
      {"  0.5e-3 ", 0.5e-3},
      {".5", 0.5},
      {"5.", 5},
      {"1E+2", 100},
      {"inf", kInf},
      {"-inf", -kInf},
      {"1 + 2*3", 7},
      {"(1 + 2)*3", 9},
      {"7 - 2 - 1", 4},
      {"12/3/2", 2},
      {"12/3*2", 8},
      {"2^3^2", 512},
      {"(2^3)^2", 64},
      {"-2^2", -4},
      {"(-2)^2", 4},
      {"2^-1", 0.5},
      {"2^-2^2", 0.0625},
      {"2*-3", -6},
      {"2 - -3", 5},
      {"--3", 3},
      {"+3", 3},
      {"-+-3", 3},
      {"2*3^2", 18},
      {"-2*3", -6},
      {"abs(-3)", 3},
      {"sqrt(16)", 4},
      {"log(1)", 0},
      {"exp(0)", 1},
      {"min(3, 1, 2)", 1},
      {"max(3, 1 + 4, 2)", 5},
      {"max(-inf, min(2, inf))", 2},
      {"((((1))))", 1},
      {"1\n+\t1", 2},
      {"1/0", kInf},
      {"0^0", 1},
  };
  for (const auto& [text, value] : table) EXPECT_EQ(constant(text), value) << text;
}

TEST(Expression, undefined_arithmetic_is_nan) {
  for (const char* text : {"0/0", "inf - inf", "0*inf", "sqrt(-1)", "log(-1)", "(-8)^(1/3)"})
    EXPECT_TRUE(std::isnan(constant(text))) << text;
}

TEST(Expression, nan_in_any_operand_gives_nan) {
  for (const char* text : {"0/0 + 1", "min(0/0, 1)", "min(1, 0/0)", "max(0/0, 1)", "max(1, 2, 0/0)", "1^(0/0)",
                           "(0/0)^0", "-(0/0)", "abs(0/0)", "exp(0/0)"})
    EXPECT_TRUE(std::isnan(constant(text))) << text;
}

TEST(Expression, works_on_whole_columns) {
  Columns columns;
  columns.count = 3;
  columns[Measure::IAE_w] = {1, 2, kNaN};
  columns[Measure::TV2_uw] = {10, 20, 30};
  columns[Parameter::kappa] = {0.1, 0.2, 0.3};
  const std::vector<double> values = evaluated(parsed("IAE_w + 0.5*TV2_uw - kappa"), columns);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0], 1 + 5 - 0.1);
  EXPECT_EQ(values[1], 2 + 10 - 0.2);
  EXPECT_TRUE(std::isnan(values[2]));
}

TEST(Expression, a_stack_serves_expressions_and_blocks_of_any_size) {
  Columns columns;
  columns.count = 2;
  columns[Measure::Ms] = {1, 2};
  ColumnStack stack;
  std::vector<double> values;
  parsed("Ms + (Ms + (Ms + 1))").evaluate(columns, stack, values);
  EXPECT_EQ(values, (std::vector<double>{4, 7}));
  columns.count = 1;
  columns[Measure::Ms] = {5};
  parsed("Ms*2").evaluate(columns, stack, values);
  EXPECT_EQ(values, std::vector<double>{10});
}

TEST(Expression, knows_every_measure_and_parameter) {
  for (const std::string_view name : quantity_names()) {
    const auto quantity = parsed(std::string(name)).single_quantity();
    ASSERT_TRUE(quantity) << name;
    EXPECT_EQ(to_string(*quantity), name);
  }
  EXPECT_EQ(quantity_names().size(), kQuantityCount);
}

TEST(Expression, every_quantity_has_a_column_of_its_own) {
  std::set<std::size_t> places;
  for (const std::string_view name : quantity_names()) places.insert(position(quantity_named(name).value()));
  EXPECT_EQ(places.size(), kQuantityCount);
  EXPECT_EQ(*places.rbegin(), kQuantityCount - 1);
}

TEST(Expression, says_what_it_is) {
  const Expression expression = parsed("  kappa*tau_i ");
  EXPECT_EQ(expression.text(), "kappa*tau_i");
  ASSERT_EQ(expression.uses().size(), 2u);
  EXPECT_EQ(expression.uses()[1].offset, 8u);
  EXPECT_FALSE(expression.constant());
  EXPECT_FALSE(expression.single_quantity());
  EXPECT_FALSE(parsed("2").single_quantity());
  EXPECT_FALSE(parsed("-kappa").single_quantity());
  EXPECT_TRUE(parsed("(kappa)").single_quantity());
}

std::string repeated(const std::string& piece, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) text += piece;
  return text;
}

TEST(Expression, depth_is_limited) {
  EXPECT_EQ(constant(repeated("(", 99) + "1" + repeated(")", 99)), 1);
  EXPECT_EQ(constant(repeated("-", 99) + "1"), -1);
  for (const std::string piece : {"(", "-", "+", "2^", "abs(", "min(1,"}) {
    const std::string message = problem(repeated(piece, 100) + "1");
    EXPECT_NE(message.find("nested deeper than 100 levels"), std::string::npos) << piece << ": " << message;
  }
  EXPECT_EQ(problem(repeated("-", 101) + "1").substr(0, 44), "--minimize:1:101: nested deeper than 100 lev");
}

TEST(Expression, long_sums_and_lists_are_not_deep) {
  EXPECT_EQ(constant("0" + repeated("+1", 2000)), 2000);
  EXPECT_EQ(constant("max(0" + repeated(",7", 1000) + ")"), 7);
}

TEST(Expression, a_level_holds_at_most_three_columns) {
  ColumnStack stack;
  Columns none;
  none.count = 1;
  std::vector<double> value;
  parsed(repeated("0 + 1*max(1,", 99) + "5" + repeated(")", 99)).evaluate(none, stack, value);
  EXPECT_EQ(value, std::vector<double>{5});
  EXPECT_EQ(stack.size(), 3u * 99 + 1);
}

TEST(Expression, length_is_limited) {
  EXPECT_EQ(constant(std::string(kMaxQueryText - 1, ' ') + "1"), 1);
  EXPECT_EQ(problem(std::string(kMaxQueryText, ' ') + "1"),
            "--minimize:1:1: the text is too long: 4097 characters, at most 4096");
}

const std::vector<Quantity> kSome = {Measure::IAE_w, Measure::TV2_uw, Measure::Ms, Parameter::kappa,
                                     Parameter::tau_i};

Columns some_columns() {
  std::mt19937 random(7);
  const std::vector<double> pool = {0, -1, 1, 2.5, -0.3, 1e-9, 1e200, kInf, -kInf, kNaN};
  Columns columns;
  columns.count = 40;
  for (const Quantity quantity : kSome)
    for (std::size_t i = 0; i < columns.count; ++i) columns[quantity].push_back(pool[random() % pool.size()]);
  return columns;
}

RC_GTEST_PROP(ExpressionProperty, reads_back_what_a_tree_prints, ()) {
  const Tree tree = random_tree(5, kSome);
  const std::string text = print(tree);
  RC_PRE(text.size() <= kMaxQueryText);
  const Columns columns = some_columns();
  const std::vector<double> values = evaluated(parsed(text), columns);
  RC_LOG() << text;
  for (std::size_t i = 0; i < columns.count; ++i)
    RC_ASSERT(identical(values[i], value_of(tree, [&](Quantity q) { return columns[q][i]; })));
}

/// Either an expression that can be evaluated or an InputError about the text; never anything else.
void parses_or_says_why(const std::string& text) {
  try {
    const Expression expression = parsed(text);
    Columns columns;
    columns.count = 1;
    for (const Expression::Use& use : expression.uses()) columns[use.quantity] = {1};
    RC_ASSERT(evaluated(expression, columns).size() == 1u);
  } catch (const InputError& error) {
    RC_ASSERT(std::string(error.what()).starts_with("--minimize:"));
  }
}

RC_GTEST_PROP(ExpressionProperty, random_bytes_parse_or_are_refused, (const std::string& bytes)) {
  parses_or_says_why(bytes);
}

RC_GTEST_PROP(ExpressionProperty, random_words_parse_or_are_refused, ()) {
  const auto words = *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
      "(", ")", "(", ")", "+", "-", "*", "/", "^", ",", " ", "1", "2.5", "e3", "IAE_w", "kappa", "min(", "abs(",
      "inf", "<=", "==", "=", ".", "_", "\n", "\x80"));
  std::string text;
  for (const std::string& word : words) text += word;
  parses_or_says_why(text);
}

}  // namespace
}  // namespace portrait
