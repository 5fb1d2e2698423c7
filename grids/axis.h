/// One axis of a grid: a parameter and its values, strictly increasing.
///
/// A value is what a person would write: each is rounded to the nearest number of 15 decimal digits, so that
/// the eighth value of 0.35, 0.40, ... is the double 0.7 and not 0.7000000000000001.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/loop/parameters.h"

namespace portrait {

class Axis {
 public:
  /// from, ..., to in equal steps. REQUIRES: count >= 2 and from < to, both finite.
  static Axis linear(Parameter parameter, double from, double to, std::uint64_t count);
  /// from, ..., to in equal ratios. REQUIRES: count >= 2 and 0 < from < to, both finite.
  static Axis logarithmic(Parameter parameter, double from, double to, std::uint64_t count);
  /// The values themselves; the last may be inf. REQUIRES: not empty, strictly increasing.
  static Axis list(Parameter parameter, std::vector<double> values);

  Parameter parameter() const { return parameter_; }
  std::string_view name() const { return to_string(parameter_); }
  std::uint64_t size() const { return size_; }
  double operator[](std::uint64_t i) const;
  std::vector<double> values() const;

 private:
  enum class Scale { linear, logarithmic, list };
  Axis(Parameter parameter, Scale scale, double from, double to, std::uint64_t size)
      : parameter_(parameter), scale_(scale), from_(from), to_(to), size_(size) {}

  Parameter parameter_;
  Scale scale_;
  double from_, to_;
  std::uint64_t size_;
  std::vector<double> list_;
};

}  // namespace portrait
