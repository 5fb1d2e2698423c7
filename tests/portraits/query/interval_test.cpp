/// Bounds against values: whatever an expression gives for numbers out of the intervals lies in its bound.
#include "portraits/query/interval.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "portraits/query/constraint.h"
#include "tests/portraits/query/expression_tree.h"

namespace portrait {
namespace {

const std::vector<Quantity> kNamed = {Measure::IAE_w, Measure::IAE_d, Parameter::kappa};

struct Box {
  std::array<std::vector<double>, 3> values;  ///< of each name: what it can be

  static std::size_t index(Quantity quantity) {
    return static_cast<std::size_t>(std::find(kNamed.begin(), kNamed.end(), quantity) - kNamed.begin());
  }
  Interval bound(Quantity quantity) const {
    Interval hull = Interval::none();
    hull.may_be_nan = false;
    for (const double value : values[index(quantity)]) {
      hull.may_be_nan |= std::isnan(value);
      if (value < hull.low) hull.low = value;
      if (value > hull.high) hull.high = value;
    }
    return hull;
  }
};

Box random_box() {
  Box box;
  const std::vector<double> pool = {-kInf, -1e300, -3,  -1, -0.5, -1e-300, -0.0,  0.0,  1e-300, 0.1,
                                    0.5,   1,      1.7, 2,  5,    1e5,     1e300, kInf, kNaN};
  for (std::vector<double>& values : box.values) {
    const int count = *rc::gen::inRange(1, 5);
    const bool tame = *rc::gen::arbitrary<bool>();
    for (int i = 0; i < count; ++i)
      values.push_back(tame ? 0.01 * *rc::gen::inRange(0, 1000) : *rc::gen::elementOf(pool));
  }
  return box;
}

RC_GTEST_PROP(IntervalProperty, encloses_every_value, ()) {
  const Tree tree = random_tree(*rc::gen::inRange(0, 4), kNamed);
  const Box box = random_box();
  std::vector<Interval> stack;
  const Expression expression = parse_expression({"test", print(tree)});
  const Interval bound = expression.bound([&](Quantity quantity) { return box.bound(quantity); }, stack);
  RC_LOG() << print(tree) << " in [" << bound.low << ", " << bound.high << "]\n";
  for (const double a : box.values[0])
    for (const double b : box.values[1])
      for (const double c : box.values[2]) {
        const double numbers[] = {a, b, c};
        const double value = value_of(tree, [&](Quantity quantity) { return numbers[Box::index(quantity)]; });
        const bool enclosed = std::isnan(value) ? bound.may_be_nan : bound.low <= value && value <= bound.high;
        RC_ASSERT(enclosed);
      }
}

RC_GTEST_PROP(IntervalProperty, an_outlook_is_never_wrong, ()) {
  const Box box = random_box();
  const auto relation = static_cast<Relation>(*rc::gen::inRange(0, 5));
  const Outlook found = outlook(relation, box.bound(kNamed[0]), box.bound(kNamed[1]));
  for (const double a : box.values[0])
    for (const double b : box.values[1]) {
      const bool held = holds(relation, a, b);
      RC_ASSERT(found == Outlook::maybe || held == (found == Outlook::always));
    }
}

TEST(Interval, bounds_are_tight_where_they_can_be) {
  const Interval x{1, 2, false}, y{-3, 4, false};
  EXPECT_EQ((x + y).low, -2);
  EXPECT_EQ((x + y).high, 6);
  EXPECT_EQ((x * y).low, -6);
  EXPECT_EQ((x * y).high, 8);
  EXPECT_EQ((x - y).high, 5);
  EXPECT_EQ((y / x).low, -3);
  EXPECT_EQ(abs(y).low, 0);
  EXPECT_EQ(abs(y).high, 4);
  EXPECT_EQ(smaller(x, y).high, 2);
  EXPECT_EQ(larger(x, y).low, 1);
  EXPECT_FALSE((x * y).may_be_nan);
  EXPECT_NEAR(raised(x, {2, 3, false}).high, 8, 1e-12);
  EXPECT_NEAR(log(x).high, std::log(2), 1e-15);
}

/// Ends of which every interval is tried, with what lies in it: its ends, a number near an infinite one, its middle, 0.
constexpr std::array<double, 8> kEnds = {-kInf, -2, -0.5, 0, 0.5, 1, 3, kInf};

std::vector<Interval> all_intervals() {
  std::vector<Interval> all;
  for (std::size_t i = 0; i < kEnds.size(); ++i)
    for (std::size_t j = i; j < kEnds.size(); ++j) all.push_back({kEnds[i], kEnds[j], false});
  return all;
}

std::vector<double> some_of(const Interval& x) {
  std::vector<double> some;
  for (const double value : {x.low, x.high, 0.0, -1e300, 1e300, 0.5 * x.low + 0.5 * x.high})
    if (x.low <= value && value <= x.high) some.push_back(value);
  return some;
}

bool is_finite(const Interval& x) { return std::isfinite(x.low) && std::isfinite(x.high); }

/// Least and greatest of some values, and whether NaN is among them.
Interval hull_of(const std::vector<double>& values) {
  Interval hull{kInf, -kInf, false};
  for (const double value : values) {
    if (std::isnan(value)) {
      hull.may_be_nan = true;
      continue;
    }
    hull.low = std::min(hull.low, value);
    hull.high = std::max(hull.high, value);
  }
  return hull;
}

void expect_around(const Interval& bound, const Interval& hull, const std::string& what) {
  EXPECT_TRUE(!hull.has_numbers() || (bound.low <= hull.low && hull.high <= bound.high)) << what;
  EXPECT_TRUE(!hull.may_be_nan || bound.may_be_nan) << what;
}

void expect_just(const Interval& bound, const Interval& hull, const std::string& what) {
  EXPECT_EQ(bound.has_numbers(), hull.has_numbers()) << what;
  if (!hull.has_numbers()) return;
  EXPECT_NEAR(bound.low, hull.low, 1e-12) << what;
  EXPECT_NEAR(bound.high, hull.high, 1e-12) << what;
  EXPECT_EQ(bound.may_be_nan, hull.may_be_nan) << what;
}

TEST(Interval, of_one_operand_is_the_hull_of_its_values) {
  struct Case {
    const char* name;
    Interval (*bound)(const Interval&);
    double (*value)(double);
  };
  const std::vector<Case> cases = {{"-", [](const Interval& x) { return -x; }, [](double a) { return -a; }},
                                   {"abs", abs, [](double a) { return std::abs(a); }},
                                   {"sqrt", sqrt, [](double a) { return std::sqrt(a); }},
                                   {"log", log, [](double a) { return std::log(a); }},
                                   {"exp", exp, [](double a) { return std::exp(a); }}};
  for (const Case& one : cases) {
    for (const Interval& x : all_intervals()) {
      std::vector<double> values;
      for (const double a : some_of(x)) values.push_back(one.value(a));
      const std::string what = fmt::format("{}({}..{})", one.name, x.low, x.high);
      expect_around(one.bound(x), hull_of(values), what);
      const bool from_0 = std::string_view(one.name) == "log" && x.low <= 0;  // -inf is a bound, not to be near to
      if (is_finite(x) && !from_0) expect_just(one.bound(x), hull_of(values), what);
    }
    EXPECT_FALSE(one.bound(Interval::none()).has_numbers()) << one.name;
    EXPECT_TRUE(one.bound({1, 2, true}).may_be_nan) << one.name;
  }
}

TEST(Interval, of_two_operands_is_the_hull_of_their_values) {
  struct Case {
    const char* name;
    Interval (*bound)(const Interval&, const Interval&);
    double (*value)(double, double);
  };
  const std::vector<Case> cases = {
      {"+", [](const Interval& x, const Interval& y) { return x + y; }, [](double a, double b) { return a + b; }},
      {"-", [](const Interval& x, const Interval& y) { return x - y; }, [](double a, double b) { return a - b; }},
      {"*", [](const Interval& x, const Interval& y) { return x * y; }, [](double a, double b) { return a * b; }},
      {"/", [](const Interval& x, const Interval& y) { return x / y; }, [](double a, double b) { return a / b; }},
      {"^", raised, [](double a, double b) { return std::pow(a, b); }},
      {"min", smaller, [](double a, double b) { return std::min(a, b); }},
      {"max", larger, [](double a, double b) { return std::max(a, b); }}};
  const Interval whole{-kInf, kInf, false};
  for (const Case& one : cases) {
    for (const Interval& x : all_intervals())
      for (const Interval& y : all_intervals()) {
        std::vector<double> values;
        for (const double a : some_of(x))
          for (const double b : some_of(y)) values.push_back(one.value(a, b));
        const std::string what = fmt::format("{}..{} {} {}..{}", x.low, x.high, one.name, y.low, y.high);
        expect_around(one.bound(x, y), hull_of(values), what);
        const bool divides = std::string_view(one.name) == "/", raises = std::string_view(one.name) == "^";
        const bool unbounded = (divides && y.low <= 0 && y.high >= 0) || (raises && x.low <= 0);
        if (is_finite(x) && is_finite(y) && !unbounded) expect_just(one.bound(x, y), hull_of(values), what);
      }
    EXPECT_FALSE(one.bound(Interval::none(), whole).has_numbers()) << one.name;
    EXPECT_FALSE(one.bound(whole, Interval::none()).has_numbers()) << one.name;
    EXPECT_TRUE(one.bound({1, 2, true}, {1, 2, false}).may_be_nan) << one.name;
    EXPECT_TRUE(one.bound({1, 2, false}, {1, 2, true}).may_be_nan) << one.name;
  }
  EXPECT_FALSE((Interval{1, 2, false} * Interval{1, kInf, false}).may_be_nan);
  EXPECT_FALSE((Interval{1, kInf, false} + Interval{1, kInf, false}).may_be_nan);
  EXPECT_FALSE((Interval{1, 2, false} / Interval{1, kInf, false}).may_be_nan);
}

TEST(Outlook, decides_what_the_sides_leave_no_doubt_about) {
  const Interval low{1, 2, false}, high{3, 4, false}, wide{0, 9, false}, with_nan{1, 2, true};
  EXPECT_EQ(outlook(Relation::at_most, low, high), Outlook::always);
  EXPECT_EQ(outlook(Relation::at_most, high, low), Outlook::never);
  EXPECT_EQ(outlook(Relation::at_most, wide, low), Outlook::maybe);
  EXPECT_EQ(outlook(Relation::at_most, with_nan, high), Outlook::maybe);
  EXPECT_EQ(outlook(Relation::above, high, with_nan), Outlook::maybe);
  EXPECT_EQ(outlook(Relation::below, high, with_nan), Outlook::never);
  EXPECT_EQ(outlook(Relation::equal, low, high), Outlook::never);
  EXPECT_EQ(outlook(Relation::equal, Interval::of(2), Interval::of(2 + 1e-12)), Outlook::always);
  EXPECT_EQ(outlook(Relation::equal, low, Interval::of(2 + 1e-12)), Outlook::maybe);
  EXPECT_EQ(outlook(Relation::at_most, Interval::none(), wide), Outlook::never);
}

/// Over whole numbers an order holds throughout, or nowhere, just when it does for every pair of ends.
TEST(Outlook, of_an_order_is_what_all_pairs_of_ends_say) {
  for (const Relation relation : {Relation::at_most, Relation::below, Relation::at_least, Relation::above})
    for (int ends = 0; ends < 4 * 4 * 4 * 4; ++ends) {
      const double a = ends % 4, b = ends / 4 % 4, c = ends / 16 % 4, d = ends / 64;
      if (a > b || c > d) continue;
      int held = 0;
      for (const double left : {a, b})
        for (const double right : {c, d}) held += holds(relation, left, right) ? 1 : 0;
      const Outlook expected = held == 4 ? Outlook::always : held == 0 ? Outlook::never : Outlook::maybe;
      EXPECT_EQ(outlook(relation, {a, b, false}, {c, d, false}), expected)
          << a << ".." << b << " " << to_string(relation) << " " << c << ".." << d;
    }
}

TEST(Outlook, of_a_side_that_is_only_nan_is_never) {
  const Interval reaching{-kInf, kInf, false};
  for (const Relation relation :
       {Relation::at_most, Relation::below, Relation::at_least, Relation::above, Relation::equal}) {
    EXPECT_EQ(outlook(relation, Interval::none(), reaching), Outlook::never);
    EXPECT_EQ(outlook(relation, reaching, Interval::none()), Outlook::never);
  }
}

TEST(Outlook, of_equality_allows_for_numbers_that_count_as_the_same) {
  const auto of = [](double a, double b, double c, double d) {
    return outlook(Relation::equal, {a, b, false}, {c, d, false});
  };
  EXPECT_EQ(of(0, 0, 0, 0), Outlook::always);
  EXPECT_EQ(of(1, 1, 1, 2), Outlook::maybe);
  EXPECT_EQ(of(1, 2, 1, 1), Outlook::maybe);
  EXPECT_EQ(of(1e6, 1e6, 1e6 + 5e-4, 1e6 + 5e-4), Outlook::always);
  EXPECT_EQ(of(0, 1e6, 1e6 + 5e-4, 2e6), Outlook::maybe);
  EXPECT_EQ(of(1e6 + 5e-4, 2e6, 0, 1e6), Outlook::maybe);
  EXPECT_EQ(of(0, 1e6, 1e6 + 1, 2e6), Outlook::never);
}

}  // namespace
}  // namespace portrait
