#include "portraits/query/constraint.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "portraits/query/grid_values.h"
#include "tests/portraits/query/error_text.h"

namespace portrait {
namespace {

Constraint parsed(const std::string& text) { return parse_constraint({"--where", text}); }

std::string problem(const std::string& text) {
  return error_text([&] { parsed(text); });
}

Grid small_grid() {
  Grid grid;
  grid.family = {Plant::dipdt, 1, Prefilter::full};
  grid.measures = {Measure::IAE_w};
  grid.axes = {Axis::linear(Parameter::kappa, 0.1, 0.5, 5), Axis::list(Parameter::tau_i, {6, 8, kInf})};
  grid.fixed = {{Parameter::tau_d, 2}, {Parameter::tau_f, 0.1}, {Parameter::b, 0}, {Parameter::c, 0}};
  return grid;
}

std::string unfit(const std::string& text) {
  return error_text([&] { require_available(parsed(text), small_grid(), false); });
}

TEST(Constraint, has_two_sides_and_a_relation) {
  const std::vector<std::pair<std::string, Relation>> table = {{"IAE_w <= 2 + kappa", Relation::at_most},
                                                               {"IAE_w < 2 + kappa", Relation::below},
                                                               {"IAE_w >= 2 + kappa", Relation::at_least},
                                                               {"IAE_w > 2 + kappa", Relation::above},
                                                               {"IAE_w == 2 + kappa", Relation::equal}};
  for (const auto& [text, relation] : table) {
    const Constraint constraint = parsed(text);
    EXPECT_EQ(constraint.text(), text);
    EXPECT_EQ(constraint.left.text(), "IAE_w");
    EXPECT_EQ(constraint.relation, relation);
    EXPECT_EQ(constraint.right.text(), "2 + kappa");
  }
  EXPECT_EQ(parsed("1<-2").right.constant(), -2);
  EXPECT_EQ(to_string(Relation::at_least), ">=");
}

TEST(Constraint, relations_hold_as_in_mathematics) {
  EXPECT_TRUE(holds(Relation::at_most, 1, 1));
  EXPECT_FALSE(holds(Relation::at_most, 1.0000000001, 1));
  EXPECT_TRUE(holds(Relation::below, 1, 2));
  EXPECT_FALSE(holds(Relation::below, 1, 1));
  EXPECT_TRUE(holds(Relation::at_least, 1, 1));
  EXPECT_FALSE(holds(Relation::at_least, 1, 2));
  EXPECT_TRUE(holds(Relation::above, kInf, 2));
  EXPECT_FALSE(holds(Relation::above, 2, 2));
}

TEST(Constraint, equal_means_within_one_in_a_milliard) {
  EXPECT_TRUE(holds(Relation::equal, 0.1 + 0.2, 0.3));
  EXPECT_TRUE(holds(Relation::equal, 1e6, 1e6 + 9e-4));
  EXPECT_FALSE(holds(Relation::equal, 1e6, 1e6 + 2e-3));
  EXPECT_TRUE(holds(Relation::equal, kInf, kInf));
  EXPECT_FALSE(holds(Relation::equal, kInf, -kInf));
  EXPECT_FALSE(holds(Relation::equal, 8, kInf));
  EXPECT_FALSE(holds(Relation::equal, kInf, 8));
  EXPECT_TRUE(holds(Relation::equal, 0, 0));
  EXPECT_FALSE(holds(Relation::equal, 0, 1e-12));
}

TEST(GridValues, numbers_are_the_same_up_to_a_milliardth_of_the_greater) {
  EXPECT_TRUE(same_number(1e9, 1e9 - 1));
  EXPECT_TRUE(same_number(1e9 - 1, 1e9));
  EXPECT_TRUE(same_number(-1e9, 1 - 1e9));
  EXPECT_FALSE(same_number(1e9, 1e9 - 2));
  EXPECT_FALSE(same_number(1, -1));
}

TEST(Constraint, never_holds_with_nan) {
  for (const Relation relation :
       {Relation::at_most, Relation::below, Relation::at_least, Relation::above, Relation::equal}) {
    EXPECT_FALSE(holds(relation, kNaN, 1));
    EXPECT_FALSE(holds(relation, 1, kNaN));
    EXPECT_FALSE(holds(relation, kNaN, kNaN));
  }
}

TEST(Constraint, distance_is_relative_to_the_right_side) {
  EXPECT_EQ(distance(3, 2), 0.5);
  EXPECT_EQ(distance(1, -2), 1.5);
  EXPECT_EQ(distance(2, 2), 0);
  EXPECT_EQ(distance(0.5, 0), 0.5 / kTinyBound);
  EXPECT_EQ(distance(kInf, 2), kInf);
  EXPECT_EQ(distance(2, -kInf), kInf);
  EXPECT_EQ(distance(-kInf, kInf), kInf);
  EXPECT_EQ(distance(kInf, kInf), 0);
  EXPECT_TRUE(std::isnan(distance(kNaN, 2)));
  EXPECT_TRUE(std::isnan(distance(kNaN, kInf)));
  EXPECT_TRUE(std::isnan(distance(2, kNaN)));
}

TEST(Constraint, points_at_each_mistake) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"IAE_w = 3", "--where:1:7: \"=\" is not a relation (did you mean \"==\"?)\n  IAE_w = 3\n        ^"},
      {"IAE_w =< 3", "--where:1:7: \"=<\" is not a relation (did you mean \"<=\"?)\n  IAE_w =< 3\n        ^"},
      {"IAE_w => 3", "--where:1:7: \"=>\" is not a relation (did you mean \">=\"?)\n  IAE_w => 3\n        ^"},
      {"Ms \xE2\x89\xA4 2",
       "--where:1:4: \"\xE2\x89\xA4\" is not a relation (did you mean \"<=\"?)\n  Ms \xE2\x89\xA4 2\n     ^"},
      {"Ms \xE2\x89\xA5 2",
       "--where:1:4: \"\xE2\x89\xA5\" is not a relation (did you mean \">=\"?)\n  Ms \xE2\x89\xA5 2\n     ^"},
      {"Ms != 2", "--where:1:4: stray character \"!\"\n  Ms != 2\n     ^"},
      {"", "--where:1:1: the text is empty"},
      {"IAE_w", "--where:1:6: expected one of <=, <, >=, >, ==, but the text ends\n  IAE_w\n       ^"},
      {"IAE_w 3", "--where:1:7: \"3\" follows without an operator between\n  IAE_w 3\n        ^"},
      {"IAE_w)<3", "--where:1:6: \")\" has no \"(\"\n  IAE_w)<3\n       ^"},
      {"<= 3", "--where:1:1: expected a number, a name or \"(\", but there is \"<=\"\n  <= 3\n  ^"},
      {"IAE_w <=", "--where:1:9: expected a number, a name or \"(\", but the text ends\n  IAE_w <=\n          ^"},
      {"IAE_w < > 3",
       "--where:1:9: expected a number, a name or \"(\", but there is \">\"\n  IAE_w < > 3\n          ^"},
      {"0 < IAE_w < 3",
       "--where:1:11: \"<\" is a second relation; write it as a constraint of its own\n  0 < IAE_w < 3\n     "
       "       ^"},
      {"(IAE_w < 3)", "--where:1:8: \"<\" stands inside parentheses\n  (IAE_w < 3)\n         ^"},
      {"Ms < 2 and Mt < 2",
       "--where:1:8: \"and\" follows without an operator between\n  Ms < 2 and Mt < 2\n         ^"},
      {"Ms < 2, Mt < 2", "--where:1:7: \",\" stands outside a function's arguments\n  Ms < 2, Mt < 2\n        ^"},
      {"Ms < Mz", "--where:1:6: unknown name \"Mz\" (did you mean \"Ms\"?)\n  Ms < Mz\n       ^"},
  };
  for (const auto& [text, message] : table) EXPECT_EQ(problem(text), message);
}

TEST(Constraint, points_at_what_the_portrait_lacks_on_either_side) {
  EXPECT_EQ(unfit("Ms < 2"),
            "--where:1:1: measure \"Ms\" is not stored in this portrait (stored: IAE_w)\n  Ms < 2\n  ^");
  EXPECT_EQ(unfit("IAE_w < tau_1"),
            "--where:1:9: this portrait has no parameter \"tau_1\" (it has: kappa, tau_i, delta, tau_d, "
            "tau_f, b, c)\n"
            "  IAE_w < tau_1\n          ^");
}

TEST(Constraint, equal_picks_a_grid_value_or_names_the_nearest) {
  const std::string fine = "no InputError";
  EXPECT_EQ(unfit("kappa == 0.3"), fine);
  EXPECT_EQ(unfit("kappa == 0.1 + 0.2"), fine);
  EXPECT_EQ(unfit("tau_i == inf"), fine);
  EXPECT_EQ(unfit("kappa == 0.35"),
            "--where:1:1: the axis kappa has no value 0.35 (nearest: 0.3 and 0.4)\n  kappa == 0.35\n  ^");
  EXPECT_EQ(unfit("kappa == 0"), "--where:1:1: the axis kappa has no value 0 (nearest: 0.1)\n  kappa == 0\n  ^");
  EXPECT_EQ(unfit("kappa == 1"), "--where:1:1: the axis kappa has no value 1 (nearest: 0.5)\n  kappa == 1\n  ^");
  EXPECT_EQ(unfit("tau_i == 9"),
            "--where:1:1: the axis tau_i has no value 9 (nearest: 8 and inf)\n  tau_i == 9\n  ^");
  EXPECT_EQ(unfit("7 == tau_i"),
            "--where:1:6: the axis tau_i has no value 7 (nearest: 6 and 8)\n  7 == tau_i\n       ^");
  EXPECT_EQ(unfit("tau_f == 0.1"), fine);
  EXPECT_EQ(unfit("tau_f == 0.2"),
            "--where:1:1: tau_f is 0.1 in the whole portrait, never 0.2\n  tau_f == 0.2\n  ^");
}

TEST(Constraint, only_a_bare_name_and_a_number_are_looked_up) {
  for (const char* text : {"kappa <= 0.35", "2*kappa == 0.35", "kappa == IAE_w", "IAE_w == 0.35", "delta == 0.35"})
    EXPECT_EQ(unfit(text), "no InputError") << text;
}

TEST(GridValues, finds_the_nearest_of_several_that_match) {
  const std::vector<double> values = {1, 1 + 4e-10, 1 + 8e-10, 2};
  EXPECT_EQ(index_of_value(values, 1 + 5e-10), 1u);
  EXPECT_EQ(index_of_value(values, 2), 3u);
  EXPECT_EQ(index_of_value(values, 1.5), std::nullopt);
  const double apart = std::ldexp(1.0, -32);
  EXPECT_EQ(index_of_value({1 - apart, 1 + apart}, 1), 0u);  // of equally near ones the first
}

RC_GTEST_PROP(ConstraintProperty, random_words_parse_or_are_refused, ()) {
  const auto words = *rc::gen::container<std::vector<std::string>>(rc::gen::element<std::string>(
      "(", ")", "+", "-", "1", "IAE_w", "kappa", "<=", "<", ">", ">=", "==", "=", " ", ","));
  std::string text;
  for (const std::string& word : words) text += word;
  try {
    RC_ASSERT(parsed(text).text() == text);
  } catch (const InputError& error) {
    RC_ASSERT(std::string(error.what()).starts_with("--where:"));
  }
}

}  // namespace
}  // namespace portrait
