/// One axis of a grid: a parameter and its values, strictly increasing.
///
/// Values are computed when asked for, so an axis of 10^12 values costs no memory. What was written (both ends,
/// every value of a list) stays as written; what is computed is what a person would write: rounded to 15
/// significant digits, so that the eighth value of 0.35, 0.40, ... is the double 0.7 and not 0.7000000000000001. On
/// a linear axis these are digits of the larger end, so that -0.1, 0, 0.1, ... holds a true 0.
///
/// unit      normalised, as the parameter
/// accuracy  exact to the 15 digits: tests/grids/axis_test.cpp
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/loop/parameters.h"

namespace portrait {

class Axis {
 public:
  /// from, ..., to in equal steps. REQUIRES: from < to, both finite; 2 <= count <= most_linear(from, to).
  static Axis linear(Parameter parameter, double from, double to, std::uint64_t count);
  /// from, ..., to in equal ratios. REQUIRES: 0 < from < to < inf; 2 <= count <= most_logarithmic(from, to).
  static Axis logarithmic(Parameter parameter, double from, double to, std::uint64_t count);
  /// The values themselves; the last may be inf. REQUIRES: not empty, strictly increasing.
  static Axis list(Parameter parameter, std::vector<double> values);

  /// How many values fit between the ends before neighbours are the same to 15 digits.
  static double most_linear(double from, double to);
  static double most_logarithmic(double from, double to);

  Parameter parameter() const { return parameter_; }
  std::string_view name() const { return to_string(parameter_); }
  std::uint64_t size() const { return size_; }
  /// REQUIRES: i < size().
  double operator[](std::uint64_t i) const;
  std::vector<double> values() const;

 private:
  enum class Scale { linear, logarithmic, list };
  Axis(Parameter parameter, Scale scale, double from, double to, std::uint64_t size)
      : parameter_(parameter), scale_(scale), from_(from), to_(to), size_(size) {}

  double linear_value(std::uint64_t i) const;
  double logarithmic_value(std::uint64_t i) const;

  Parameter parameter_;
  Scale scale_;
  double from_, to_;
  std::uint64_t size_;
  int decimals_ = 0;  ///< of a linear axis: as many as its values have
  std::vector<double> list_;
};

}  // namespace portrait
