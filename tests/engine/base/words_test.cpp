#include "engine/base/words.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace portrait {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::vector<std::string_view> kParameterNames = {"kappa", "tau_i", "delta", "tau_d", "tau_f", "b", "c"};

TEST(EditDistance, CountsInsertionsDeletionsAndSubstitutions) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("kappa", "kappa"), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kapa", "kappa"), 1u);
  EXPECT_EQ(edit_distance("kappaa", "kappa"), 1u);
  EXPECT_EQ(edit_distance("kabba", "kappa"), 2u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(EditDistance, CountsASwapOfNeighboursOnce) {
  EXPECT_EQ(edit_distance("tua_i", "tau_i"), 1u);
  EXPECT_EQ(edit_distance("ab", "ba"), 1u);
  // Optimal string alignment: no part is edited twice, or this would be 2.
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);
}

TEST(EditDistance, IgnoresLetterCase) {
  EXPECT_EQ(edit_distance("Kappa", "kAPPA"), 0u);
  EXPECT_EQ(edit_distance("ATU_I", "tau_i"), 1u);
}

TEST(EditDistance, IsSymmetric) {
  const std::vector<std::string_view> words = {"", "a", "tau_i", "tua", "iae_w", "IAE_d", "delta", "detla"};
  for (const auto a : words)
    for (const auto b : words) EXPECT_EQ(edit_distance(a, b), edit_distance(b, a)) << a << " " << b;
}

TEST(NearestWord, FindsASlipOfThePen) {
  EXPECT_EQ(nearest_word("kapa", kParameterNames), "kappa");
  EXPECT_EQ(nearest_word("Tau_I", kParameterNames), "tau_i");
  EXPECT_EQ(nearest_word("dleta", kParameterNames), "delta");
}

TEST(NearestWord, OfSeveralEquallyNearTakesTheFirst) {
  EXPECT_EQ(nearest_word("tau_x", kParameterNames), "tau_i");
  EXPECT_EQ(nearest_word("a", {"b", "c"}), "b");
}

TEST(NearestWord, AllowsAThirdOfTheLettersAndAtLeastOne) {
  EXPECT_EQ(nearest_word("xb", {"b"}), "b");
  EXPECT_EQ(nearest_word("abcxyz", {"abcdez"}), "abcdez");
  EXPECT_EQ(nearest_word("abcxyz", {"abcdef"}), std::nullopt);
  EXPECT_EQ(nearest_word("gain", kParameterNames), std::nullopt);
  EXPECT_EQ(nearest_word("kappa", {}), std::nullopt);
}

TEST(Suggestion, NamesTheNearestWordOrAllOfThem) {
  EXPECT_EQ(suggestion("kapa", kParameterNames), " (did you mean \"kappa\"?)");
  EXPECT_EQ(suggestion("gain", kParameterNames), " (known: kappa, tau_i, delta, tau_d, tau_f, b, c)");
}

TEST(Joined, PutsCommasBetween) {
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"a"}), "a");
  EXPECT_EQ(joined({"a", "b", "c"}), "a, b, c");
}

TEST(ParseNumber, ReadsNumbersAsPeopleWriteThem) {
  EXPECT_EQ(parse_number("1"), 1.0);
  EXPECT_EQ(parse_number("+1.5"), 1.5);
  EXPECT_EQ(parse_number("-2.5e-3"), -2.5e-3);
  EXPECT_EQ(parse_number("1E3"), 1000.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("5."), 5.0);
  EXPECT_EQ(parse_number("0.1"), 0.1);
}

TEST(ParseNumber, ReadsInfinity) {
  EXPECT_EQ(parse_number("inf"), kInfinity);
  EXPECT_EQ(parse_number("+inf"), kInfinity);
  EXPECT_EQ(parse_number("-inf"), -kInfinity);
  EXPECT_EQ(parse_number("INF"), kInfinity);
}

TEST(ParseNumber, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"", "+", "-", "e5", "kappa", "nan", "NaN", "-nan", "nan(1)", "--1", "++1", "+-1", "-+1", "+-inf"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(ParseNumber, RefusesTextAroundTheNumber) {
  for (const char* text : {" 1", "1 ", "1x", "1,5", "1.2.3", "0x10", "1e", "1..2", "infx", "1 2"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(ParseNumber, RefusesWhatNoDoubleHolds) {
  EXPECT_EQ(parse_number("1e400"), std::nullopt);
  EXPECT_EQ(parse_number("1e308"), 1e308);
}

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(8), "8");
  EXPECT_EQ(number_text(-2.5e-30), "-2.5e-30");
  EXPECT_EQ(number_text(kInfinity), "inf");
  EXPECT_EQ(number_text(-kInfinity), "-inf");
  EXPECT_EQ(number_text(std::nan("")), "nan");
}

TEST(NumberText, ReadsBackAsTheSameDouble) {
  for (double x = 1e-300; x < 1e300; x *= 1234.56789) EXPECT_EQ(parse_number(number_text(x)), x);
}

}  // namespace
}  // namespace portrait
