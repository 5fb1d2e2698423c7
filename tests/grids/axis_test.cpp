#include "grids/axis.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "engine/base/check.h"

namespace portrait {
namespace {

constexpr Parameter kAny = Parameter::kappa;

TEST(Axis, LinearValuesAreTheDecimalNumbersOfAPerson) {
  const Axis delta = Axis::linear(kAny, 0.35, 1.05, 15);
  for (std::uint64_t i = 0; i < 15; ++i) EXPECT_EQ(delta[i], (35 + 5 * static_cast<double>(i)) / 100) << i;
  EXPECT_EQ(delta[7], 0.7);  // 0.35 + 7 * 0.05 is 0.7000000000000001

  const Axis kappa = Axis::linear(kAny, 0.01, 1.6, 160);
  for (std::uint64_t i = 0; i < 160; ++i) EXPECT_EQ(kappa[i], (static_cast<double>(i) + 1) / 100) << i;
}

/// Read from text, digit by digit: whatever shortcut an axis takes gives the same double.
double through_text(double from, double to, long double part, int decimals) {
  const auto value = static_cast<double>(from * (1 - part) + to * part);
  return std::strtod(fmt::format("{:.{}f}", value, decimals).c_str(), nullptr) + 0.0;
}

RC_GTEST_PROP(Axis, LinearValuesAreThoseThatTheirTextReadsAs, ()) {
  const int exponent = *rc::gen::inRange(-9, 12);  // of the larger end
  const int digits = *rc::gen::inRange(1, 16);
  const auto largest = static_cast<std::int64_t>(std::pow(10, digits));
  const auto whole = [&](std::int64_t least) { return static_cast<double>(*rc::gen::inRange(least, largest)); };
  const double to = whole(largest / 10) / std::pow(10, digits - 1) * std::pow(10, exponent);
  const double from = to * (whole(0) / static_cast<double>(largest) * 2 - 1);
  RC_PRE(from < to);
  const auto size = static_cast<std::uint64_t>(*rc::gen::inRange(3, 100'000));
  RC_PRE(static_cast<double>(size) <= Axis::most_linear(from, to));
  const Axis axis = Axis::linear(kAny, from, to, size);
  const int decimals = 14 - static_cast<int>(std::floor(std::log10(to)));
  RC_PRE(decimals >= 0);
  for (std::uint64_t i = 1; i + 1 < size; i += 1 + size / 500)
    RC_ASSERT(axis[i] == through_text(from, to, static_cast<long double>(i) / static_cast<long double>(size - 1), decimals));
}

TEST(Axis, ATieOfTheLastDigitIsRoundedAsItsTextIs) {
  const double to = 1.0000000000001;  // four steps of two and a half units of the 15th digit
  const Axis halves = Axis::linear(kAny, 1, to, 5);
  for (std::uint64_t i = 1; i < 4; ++i)
    EXPECT_EQ(halves[i], through_text(1, to, static_cast<long double>(i) / 4, 14)) << i;
}

TEST(Axis, LinearAxisThroughZeroHoldsATrueZero) {
  const Axis axis = Axis::linear(kAny, -0.1, 0.3, 41);
  for (std::uint64_t i = 0; i < 41; ++i) EXPECT_EQ(axis[i], (static_cast<double>(i) - 10) / 100) << i;
  EXPECT_FALSE(std::signbit(axis[10]));
}

TEST(Axis, LogarithmicDecadesAreExact) {
  const Axis decades = Axis::logarithmic(kAny, 0.001, 1000, 7);
  EXPECT_EQ(decades.values(), (std::vector<double>{0.001, 0.01, 0.1, 1, 10, 100, 1000}));
  const Axis quarters = Axis::logarithmic(kAny, 0.01, 1, 9);
  EXPECT_EQ(quarters[1], 0.0177827941003892);
  EXPECT_EQ(quarters[4], 0.1);
}

TEST(Axis, WhatWasWrittenStaysAsWritten) {
  const double from = 0.12345678901234567, to = 1.2345678901234567;
  for (const Axis& axis : {Axis::linear(kAny, from, to, 5), Axis::logarithmic(kAny, from, to, 5)}) {
    EXPECT_EQ(axis[0], from);
    EXPECT_EQ(axis[4], to);
  }
  const std::vector<double> values = {from, to, 8, kInf};
  EXPECT_EQ(Axis::list(kAny, values).values(), values);
}

TEST(Axis, NoNegativeZero) {
  EXPECT_FALSE(std::signbit(Axis::list(kAny, {-0.0, 1})[0]));
  EXPECT_FALSE(std::signbit(Axis::linear(kAny, -0.0, 1, 3)[0]));
  EXPECT_FALSE(std::signbit(Axis::linear(kAny, -1, -0.0, 3)[2]));
}

TEST(Axis, ATrillionValuesCostNoMemory) {
  const Axis axis = Axis::linear(kAny, 0, 1, 1'000'000'000'001);
  EXPECT_EQ(axis.size(), 1'000'000'000'001u);
  EXPECT_EQ(axis[1], 1e-12);
  EXPECT_EQ(axis[123'456'789'012], 0.123456789012);
  EXPECT_EQ(axis[axis.size() - 1], 1);
}

TEST(Axis, ExtremeEndsGiveFiniteIncreasingValues) {
  for (const Axis& axis : {Axis::linear(kAny, -1e308, 1e308, 101), Axis::linear(kAny, 0, 1e-300, 101),
                           Axis::linear(kAny, 0, 3e-320, 101), Axis::logarithmic(kAny, 1e-300, 1e300, 101),
                           Axis::logarithmic(kAny, 1, 1.0000000000001, 5)}) {
    const std::vector<double> values = axis.values();
    EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }));
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end(), std::less_equal<>())) << values[0];
  }
}

TEST(Axis, BrokenRequirementsAreCaught) {
  EXPECT_THROW(Axis::linear(kAny, 1, 1, 2), BrokenPromise);
  EXPECT_THROW(Axis::linear(kAny, 1, kInf, 2), BrokenPromise);
  EXPECT_THROW(Axis::linear(kAny, 0, 1, 1), BrokenPromise);
  EXPECT_THROW(Axis::linear(kAny, 0, 1, 1'000'000'000'000'000), BrokenPromise);
  EXPECT_THROW(Axis::logarithmic(kAny, 0, 1, 2), BrokenPromise);
  EXPECT_THROW(Axis::logarithmic(kAny, 1, 1.001, 1'000'000'000'000), BrokenPromise);
  EXPECT_THROW(Axis::list(kAny, {}), BrokenPromise);
  EXPECT_THROW(Axis::list(kAny, {1, 1}), BrokenPromise);
  EXPECT_THROW(Axis::list(kAny, {kNaN}), BrokenPromise);
}

/// Mantissas and exponents apart, so that the ends spread over all magnitudes.
double any_magnitude() {
  const int mantissa = *rc::gen::inRange(1, 1'000'000);
  return mantissa * std::pow(10.0, *rc::gen::inRange(-20, 20));
}

void check_increasing(const Axis& axis) {
  const std::uint64_t last = axis.size() - 1;
  const std::uint64_t i = *rc::gen::inRange<std::uint64_t>(0, last);
  RC_ASSERT(axis[i] < axis[i + 1]);
  RC_ASSERT(axis[0] < axis[1]);
  RC_ASSERT(axis[last - 1] < axis[last]);
}

RC_GTEST_PROP(AxisProperty, LinearValuesIncreaseUpToTheMostThatFit, ()) {
  const double a = any_magnitude() * *rc::gen::element(-1, 1), b = any_magnitude();
  RC_PRE(a != b);
  const double most = Axis::most_linear(std::min(a, b), std::max(a, b));
  RC_PRE(most >= 2);
  const auto count = *rc::gen::element(2.0, std::floor(std::sqrt(most)) + 1, most);
  check_increasing(Axis::linear(kAny, std::min(a, b), std::max(a, b), static_cast<std::uint64_t>(count)));
}

RC_GTEST_PROP(AxisProperty, LogarithmicValuesIncreaseUpToTheMostThatFit, ()) {
  const double a = any_magnitude(), b = any_magnitude();
  RC_PRE(a != b);
  const double most = Axis::most_logarithmic(std::min(a, b), std::max(a, b));
  RC_PRE(most >= 2);
  const auto count = *rc::gen::element(2.0, std::floor(std::sqrt(most)) + 1, most);
  check_increasing(Axis::logarithmic(kAny, std::min(a, b), std::max(a, b), static_cast<std::uint64_t>(count)));
}

}  // namespace
}  // namespace portrait
