/// Every mistake in an expression, with the whole message.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/base/words.h"
#include "portraits/query/expression.h"
#include "tests/portraits/query/error_text.h"

namespace portrait {
namespace {

Expression parsed(const std::string& text) { return parse_expression({"--minimize", text}); }

std::string problem(const std::string& text) {
  return error_text([&] { parsed(text); });
}

TEST(ExpressionErrors, points_at_each_mistake) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"IAE_d + IAE_x",
       "--minimize:1:9: unknown name \"IAE_x\" (did you mean \"IAE_w\"?)\n  IAE_d + IAE_x\n          ^"},
      {"iae_w", "--minimize:1:1: unknown name \"iae_w\" (did you mean \"IAE_w\"?)\n  iae_w\n  ^"},
      {"Kapa", "--minimize:1:1: unknown name \"Kapa\" (did you mean \"kappa\"?)\n  Kapa\n  ^"},
      {"1 + Inf", "--minimize:1:5: unknown name \"Inf\" (did you mean \"inf\"?)\n  1 + Inf\n      ^"},
      {"overshoot", "--minimize:1:1: unknown name \"overshoot\" (known: " + joined(quantity_names()) +
                        ", inf)\n  overshoot\n  ^"},
      {"sqr(2)", "--minimize:1:1: unknown function \"sqr\" (did you mean \"sqrt\"?)\n  sqr(2)\n  ^"},
      {"median(1, 2)",
       "--minimize:1:1: unknown function \"median\" (known: abs, min, max, sqrt, log, exp)\n  median(1, 2)\n "
       " ^"},
      {"", "--minimize:1:1: the text is empty"},
      {" \t\n", "--minimize:1:1: the text is empty"},
      {"1 +", "--minimize:1:4: expected a number, a name or \"(\", but the text ends\n  1 +\n     ^"},
      {"*2", "--minimize:1:1: expected a number, a name or \"(\", but there is \"*\"\n  *2\n  ^"},
      {"2**3", "--minimize:1:3: expected a number, a name or \"(\", but there is \"*\"\n  2**3\n    ^"},
      {"()", "--minimize:1:2: expected a number, a name or \"(\", but there is \")\"\n  ()\n   ^"},
      {"min(1,)", "--minimize:1:7: expected a number, a name or \"(\", but there is \")\"\n  min(1,)\n        ^"},
      {"2*(1 + (3)", "--minimize:1:3: this \"(\" is never closed\n  2*(1 + (3)\n    ^"},
      {"max(1, 2", "--minimize:1:4: this \"(\" is never closed\n  max(1, 2\n     ^"},
      {"1 + 2)", "--minimize:1:6: \")\" has no \"(\"\n  1 + 2)\n       ^"},
      {"1, 2", "--minimize:1:2: \",\" stands outside a function's arguments\n  1, 2\n   ^"},
      {"(1, 2)", "--minimize:1:3: \",\" stands outside a function's arguments\n  (1, 2)\n    ^"},
      {"2 kappa", "--minimize:1:3: \"kappa\" follows without an operator between\n  2 kappa\n    ^"},
      {"kappa(2)", "--minimize:1:6: \"(\" follows without an operator between\n  kappa(2)\n       ^"},
      {"(1 2)", "--minimize:1:4: \"2\" follows without an operator between\n  (1 2)\n     ^"},
      {"2kappa", "--minimize:1:1: \"2kappa\" is not a number\n  2kappa\n  ^"},
      {"1.2.3", "--minimize:1:1: \"1.2.3\" is not a number\n  1.2.3\n  ^"},
      {"1 + .", "--minimize:1:5: \".\" is not a number\n  1 + .\n      ^"},
      {"2e", "--minimize:1:1: \"2e\" is not a number\n  2e\n  ^"},
      {"3e-x", "--minimize:1:1: \"3e\" is not a number\n  3e-x\n  ^"},
      {"1e400", "--minimize:1:1: \"1e400\" is outside the range of numbers\n  1e400\n  ^"},
      {"abs", "--minimize:1:1: \"abs\" is a function: write abs(...)\n  abs\n  ^"},
      {"1 + abs()", "--minimize:1:5: abs takes one argument (it has 0)\n  1 + abs()\n      ^"},
      {"sqrt(1, 2)", "--minimize:1:1: sqrt takes one argument (it has 2)\n  sqrt(1, 2)\n  ^"},
      {"min(1)", "--minimize:1:1: min takes two or more arguments (it has 1)\n  min(1)\n  ^"},
      {"max()", "--minimize:1:1: max takes two or more arguments (it has 0)\n  max()\n  ^"},
      {"IAE_w <= 3",
       "--minimize:1:7: \"<=\" makes a constraint; an expression has no relation\n  IAE_w <= 3\n        ^"},
      {"(IAE_w < 3)", "--minimize:1:8: \"<\" stands inside parentheses\n  (IAE_w < 3)\n         ^"},
      {"IAE_w = 3", "--minimize:1:7: \"=\" is not a relation (did you mean \"==\"?)\n  IAE_w = 3\n        ^"},
      {"IAE_w # 3", "--minimize:1:7: stray character \"#\"\n  IAE_w # 3\n        ^"},
      {"1 +\n2 $", "--minimize:2:3: stray character \"$\"\n  2 $\n    ^"},
      {"1 $\n+ 2", "--minimize:1:3: stray character \"$\"\n  1 $\n    ^"},
      {"1\t$", "--minimize:1:3: stray character \"$\"\n  1 $\n    ^"},
      {"\xCE\xBA + 1", "--minimize:1:1: stray character \"\xCE\xBA\"\n  \xCE\xBA + 1\n  ^"},
      {"\xF0\x9D\x9B\xBC + 1", "--minimize:1:1: stray character \"\xF0\x9D\x9B\xBC\"\n  \xF0\x9D\x9B\xBC + 1\n  ^"},
      {"1 \xF4\x80\x80\x80", "--minimize:1:3: stray character \"\xF4\x80\x80\x80\"\n  1 \xF4\x80\x80\x80\n    ^"},
      {"1 \xF8\x80\x80\x80", "--minimize:1:3: stray character \"\\xf8\"\n  1 ????\n    ^"},
      {std::string("1 \x01 \xFF", 5), "--minimize:1:3: stray character \"\\x01\"\n  1 ? ?\n    ^"},
      {std::string("1 \0", 3), "--minimize:1:3: stray character \"\\x00\"\n  1 ?\n    ^"},
      {"1 \xE2\x82", "--minimize:1:3: stray character \"\\xe2\"\n  1 ??\n    ^"},
  };
  for (const auto& [text, message] : table) EXPECT_EQ(problem(text), message);
}

TEST(ExpressionErrors, columns_count_characters_not_bytes) {
  EXPECT_EQ(problem("1 + (\xE2\x89\xA0 2)"),
            "--minimize:1:6: stray character \"\xE2\x89\xA0\"\n  1 + (\xE2\x89\xA0 2)\n       ^");
  EXPECT_EQ(error_text([] {
              fail_at({"t", "\xCE\xBA\xCE\xBA 2"}, 5, "here");
            }),
            "t:1:4: here\n  \xCE\xBA\xCE\xBA 2\n     ^");
}

Grid grid_with(std::vector<Measure> measures) {
  Grid grid;
  grid.family = {Plant::dipdt, 0, Prefilter::pi};
  grid.measures = std::move(measures);
  return grid;
}

TEST(ExpressionErrors, names_what_the_portrait_lacks) {
  const Grid grid = grid_with({Measure::IAE_w, Measure::TV2_uw});
  const auto lack = [&](const std::string& text) {
    return error_text([&] { require_available(parsed(text), grid, false); });
  };
  EXPECT_EQ(lack("IAE_w + TV2_uw*kappa + tau_d + b"), "no InputError");
  EXPECT_EQ(lack("IAE_w + Ms"),
            "--minimize:1:9: measure \"Ms\" is not stored in this portrait (stored: IAE_w, TV2_uw)\n"
            "  IAE_w + Ms\n          ^");
  EXPECT_EQ(lack("tau_f"),
            "--minimize:1:1: this portrait has no parameter \"tau_f\" (it has: kappa, tau_i, delta, tau_d, b)\n"
            "  tau_f\n  ^");
  EXPECT_EQ(error_text([] { require_available(parsed("Ms"), grid_with({}), false); }),
            "--minimize:1:1: measure \"Ms\" is not stored in this portrait (stored: none)\n  Ms\n  ^");
}

}  // namespace
}  // namespace portrait
