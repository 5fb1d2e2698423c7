#include "grids/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/words.h"

namespace portrait {
namespace {

constexpr int kDigits = 15;

/// Decimal exponent of the larger end: 0 for 1 .. 9.99, -1 for 0.1 .. 0.999.
int decimal_exponent(double from, double to) {
  return static_cast<int>(std::floor(std::log10(std::max(std::abs(from), std::abs(to)))));
}

constexpr std::array kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                     1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};  // all exact

/// A decimal number of so many digits is the quotient of two whole numbers that are doubles, and division rounds as
/// reading its text does. Nothing where the last digit is too near a tie for long double to tell.
std::optional<double> as_quotient(double value, int decimals) {
  if (decimals < 0 || decimals >= static_cast<int>(kPowersOfTen.size())) return std::nullopt;
  const double power = kPowersOfTen[static_cast<std::size_t>(decimals)];
  const long double scaled = static_cast<long double>(value) * power;
  const long double whole = std::rint(scaled);
  constexpr long double kLargestWhole = 0x1p53L, kDoubt = 0x1p-10L;
  if (std::abs(whole) > kLargestWhole || std::abs(std::abs(scaled - whole) - 0.5L) < kDoubt) return std::nullopt;
  return static_cast<double>(whole) / power;
}

/// The double nearest to the decimal number. No -0.
double rounded(double value, int decimals) {
  if (const auto quotient = as_quotient(value, decimals)) return *quotient + 0.0;
  const std::string text =
      decimals >= 0 ? fmt::format("{:.{}f}", value, decimals) : fmt::format("{:.{}e}", value, kDigits - 1);
  return parse_number(text).value() + 0.0;
}

double rounded_to_digits(double value) { return parse_number(fmt::format("{:.{}e}", value, kDigits - 1)).value(); }

}  // namespace

// Neighbours at least two units of the last digit apart stay apart however each is rounded. Below the normal range
// doubles have fewer digits: there the unit is their spacing, and equal ratios find no room.
double Axis::most_linear(double from, double to) {
  const double unit = std::pow(10.0, decimal_exponent(from, to) - (kDigits - 1));
  const double two_units = 2 * std::max(unit, 2 * std::numeric_limits<double>::denorm_min());
  return std::floor(to / two_units - from / two_units) + 1;
}

double Axis::most_logarithmic(double from, double to) {
  if (from < std::numeric_limits<double>::min()) return 0;
  const double two_units = 2 * std::pow(10.0, -(kDigits - 1));
  return std::floor((std::log(to) - std::log(from)) / two_units) + 1;
}

Axis Axis::linear(Parameter parameter, double from, double to, std::uint64_t count) {
  PORTRAIT_CHECK(std::isfinite(from) && std::isfinite(to) && from < to);
  PORTRAIT_CHECK(count >= 2 && static_cast<double>(count) <= most_linear(from, to));
  Axis axis(parameter, Scale::linear, from, to, count);
  axis.decimals_ = kDigits - 1 - decimal_exponent(from, to);
  return axis;
}

Axis Axis::logarithmic(Parameter parameter, double from, double to, std::uint64_t count) {
  PORTRAIT_CHECK(0 < from && from < to && std::isfinite(to));
  PORTRAIT_CHECK(count >= 2 && static_cast<double>(count) <= most_logarithmic(from, to));
  return {parameter, Scale::logarithmic, from, to, count};
}

Axis Axis::list(Parameter parameter, std::vector<double> values) {
  PORTRAIT_CHECK(!values.empty());
  for (std::size_t i = 0; i < values.size(); ++i) {
    PORTRAIT_CHECK(!std::isnan(values[i]) && (i == 0 || values[i - 1] < values[i]));
    values[i] += 0.0;  // no -0
  }
  Axis axis(parameter, Scale::list, values.front(), values.back(), values.size());
  axis.list_ = std::move(values);
  return axis;
}

// long double keeps the error far below half a unit of the 15th digit, whatever the ends.
double Axis::linear_value(std::uint64_t i) const {
  const long double part = static_cast<long double>(i) / static_cast<long double>(size_ - 1);
  const long double value = from_ * (1 - part) + to_ * part;
  return rounded(static_cast<double>(value), decimals_);
}

double Axis::logarithmic_value(std::uint64_t i) const {
  const long double part = static_cast<long double>(i) / static_cast<long double>(size_ - 1);
  const long double ratio = static_cast<long double>(to_) / static_cast<long double>(from_);
  return rounded_to_digits(static_cast<double>(from_ * std::pow(ratio, part)));
}

double Axis::operator[](std::uint64_t i) const {
  PORTRAIT_ASSERT(i < size_);
  if (scale_ == Scale::list) return list_[i];
  if (i == 0) return from_ + 0.0;
  if (i == size_ - 1) return to_ + 0.0;
  return scale_ == Scale::linear ? linear_value(i) : logarithmic_value(i);
}

std::vector<double> Axis::values() const {
  std::vector<double> all(size_);
  for (std::uint64_t i = 0; i < size_; ++i) all[i] = (*this)[i];
  return all;
}

}  // namespace portrait
