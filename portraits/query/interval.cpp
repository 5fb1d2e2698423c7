#include "portraits/query/interval.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace portrait {
namespace {

/// The C library's log, exp and pow err by less than two units in the last place, and need not be monotonic.
constexpr int kUlps = 4;

Interval widened(Interval x) {
  if (!x.has_numbers()) return Interval::none();
  for (int i = 0; i < kUlps; ++i) {
    x.low = std::nextafter(x.low, -kInf);
    x.high = std::nextafter(x.high, kInf);
  }
  return x;
}

bool contains(const Interval& x, double number) { return x.low <= number && number <= x.high; }
bool reaches_infinity(const Interval& x) { return x.low == -kInf || x.high == kInf; }

/// Around all of these; NaN among them says that NaN may come out.
Interval around(std::initializer_list<double> numbers, bool may_be_nan) {
  Interval hull{kInf, -kInf, may_be_nan};
  for (const double number : numbers) {
    hull.may_be_nan |= std::isnan(number);
    if (number < hull.low) hull.low = number;
    if (number > hull.high) hull.high = number;
  }
  return hull;
}

}  // namespace

Interval operator-(const Interval& x) {
  if (!x.has_numbers()) return Interval::none();
  return {-x.high, -x.low, x.may_be_nan};
}

Interval operator+(const Interval& x, const Interval& y) {
  if (!x.has_numbers() || !y.has_numbers()) return Interval::none();
  const bool opposite = (x.low == -kInf && y.high == kInf) || (x.high == kInf && y.low == -kInf);
  const bool may_be_nan = x.may_be_nan || y.may_be_nan || opposite;
  // inf - inf at an end: the other values reach as far as they like.
  const double low = x.low + y.low, high = x.high + y.high;
  return {std::isnan(low) ? -kInf : low, std::isnan(high) ? kInf : high, may_be_nan};
}

Interval operator-(const Interval& x, const Interval& y) { return x + -y; }

Interval operator*(const Interval& x, const Interval& y) {
  if (!x.has_numbers() || !y.has_numbers()) return Interval::none();
  const bool undefined = (contains(x, 0) && reaches_infinity(y)) || (contains(y, 0) && reaches_infinity(x));
  // 0 times inf at an end stands for 0 times large numbers, and for NaN, which is noted.
  const auto times = [](double a, double b) { return a == 0 || b == 0 ? 0 : a * b; };
  return around({times(x.low, y.low), times(x.low, y.high), times(x.high, y.low), times(x.high, y.high)},
                x.may_be_nan || y.may_be_nan || undefined);
}

Interval operator/(const Interval& x, const Interval& y) {
  if (!x.has_numbers() || !y.has_numbers()) return Interval::none();
  if (contains(y, 0)) return {};
  const bool undefined = reaches_infinity(x) && reaches_infinity(y);
  if (undefined) return {};
  return around({x.low / y.low, x.low / y.high, x.high / y.low, x.high / y.high}, x.may_be_nan || y.may_be_nan);
}

Interval abs(const Interval& x) {
  if (!x.has_numbers()) return Interval::none();
  const double far = std::max(std::abs(x.low), std::abs(x.high));
  const double near = contains(x, 0) ? 0 : std::min(std::abs(x.low), std::abs(x.high));
  return {near, far, x.may_be_nan};
}

Interval sqrt(const Interval& x) {
  if (!x.has_numbers() || x.high < 0) return Interval::none();
  return {x.low < 0 ? 0 : std::sqrt(x.low), std::sqrt(x.high), x.may_be_nan || x.low < 0};
}

Interval log(const Interval& x) {
  if (!x.has_numbers() || x.high < 0) return Interval::none();
  return widened({x.low <= 0 ? -kInf : std::log(x.low), std::log(x.high), x.may_be_nan || x.low < 0});
}

Interval exp(const Interval& x) {
  if (!x.has_numbers()) return Interval::none();
  Interval result = widened({std::exp(x.low), std::exp(x.high), x.may_be_nan});
  result.low = std::max(result.low, 0.0);
  return result;
}

/// Of a base at or above 0: monotonic in each. Of others nothing is said.
Interval raised(const Interval& x, const Interval& y) {
  if (!x.has_numbers() || !y.has_numbers()) return Interval::none();
  if (!(x.low >= 0) || (x.low == 0 && y.low < 0)) return {};  // -0 is a 0 too
  return widened(
      around({std::pow(x.low, y.low), std::pow(x.low, y.high), std::pow(x.high, y.low), std::pow(x.high, y.high)},
             x.may_be_nan || y.may_be_nan));
}

Interval smaller(const Interval& x, const Interval& y) {
  if (!x.has_numbers() || !y.has_numbers()) return Interval::none();
  return {std::min(x.low, y.low), std::min(x.high, y.high), x.may_be_nan || y.may_be_nan};
}

Interval larger(const Interval& x, const Interval& y) {
  if (!x.has_numbers() || !y.has_numbers()) return Interval::none();
  return {std::max(x.low, y.low), std::max(x.high, y.high), x.may_be_nan || y.may_be_nan};
}

}  // namespace portrait
