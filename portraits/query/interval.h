/// Every value that an expression can have over a tile, from the ranges of what it names: arithmetic over intervals.
///
/// result    encloses whatever the same operations over the values give, rounding included: +, -, *, / and sqrt round
///           monotonically, so their bounds are found at the ends; log, exp and powers are widened by kUlps
/// accuracy  tests/portraits/query/interval_test.cpp holds it against random values
#pragma once

#include "engine/loop/loop.h"

namespace portrait {

/// Values from low to high, both included, perhaps NaN besides. low > high: no value but NaN.
struct Interval {
  double low = -kInf, high = kInf;
  bool may_be_nan = true;

  static constexpr Interval of(double number) {
    return number != number ? none() : Interval{number, number, false};
  }
  static constexpr Interval none() { return {kInf, -kInf, true}; }
  bool has_numbers() const { return low <= high; }
};

Interval operator-(const Interval& x);
Interval operator+(const Interval& x, const Interval& y);
Interval operator-(const Interval& x, const Interval& y);
Interval operator*(const Interval& x, const Interval& y);
Interval operator/(const Interval& x, const Interval& y);
Interval abs(const Interval& x);
Interval sqrt(const Interval& x);
Interval log(const Interval& x);
Interval exp(const Interval& x);
Interval raised(const Interval& x, const Interval& y);
/// NaN when either is.
Interval smaller(const Interval& x, const Interval& y);
Interval larger(const Interval& x, const Interval& y);

}  // namespace portrait
