/// A plane of a portrait: two axes run, all others are held. What pictures and pages show of it.
///
/// shape     values[j * nx + i] belongs to the i-th value of x and the j-th of y
/// unit      that of the question, as in query_units.h
/// cost      the settings of the plane in the order of their numbers, a run along the last axis at a time
#pragma once

#include <cstdint>
#include <vector>

#include "portraits/query/parameter_columns.h"
#include "portraits/query/query.h"

namespace portrait {

/// REQUIRES: below, the axis exists.
std::size_t axis_index(const Grid& grid, Parameter parameter);
bool has_axis(const Grid& grid, Parameter parameter);

class CrossSection {
 public:
  /// `held`: an index for every axis of the grid; those of x and y do not matter.
  /// REQUIRES: x and y are two different axes; the source outlives this.
  CrossSection(const ColumnSource& source, const QueryUnits& units, Parameter x, Parameter y,
               std::vector<std::uint64_t> held);

  std::size_t nx() const { return x_values_.size(); }
  std::size_t ny() const { return y_values_.size(); }
  const std::vector<double>& x_values() const { return x_values_; }
  const std::vector<double>& y_values() const { return y_values_; }
  const std::vector<Status>& statuses() const { return statuses_; }
  const std::vector<std::uint64_t>& numbers() const { return numbers_; }

  /// REQUIRES: require_available(expression, grid, has a plant).
  std::vector<double> values(const Expression& expression) const;

  /// Whether each setting is admissible for the question, as `ask` counts it; the plant's slice is the caller's.
  std::vector<bool> admissible(const Question& question) const;

  /// How far each setting is from breaking a constraint: the largest of (left - right)/|right| over those of the
  /// form <= or <, of (right - left)/|right| over those of the form >= or >; admissible ones are at or below 0.
  /// NaN where a side is NaN or the status is not eligible. Constraints with == do not count.
  std::vector<double> violation(const Question& question) const;

 private:
  void gather(Quantity quantity, std::vector<double>& values) const;
  void gather(Measure measure, std::vector<double>& values) const;
  void gather(Parameter parameter, std::vector<double>& values) const;
  void gather(ControllerValue value, std::vector<double>& values) const;
  std::vector<bool> eligible(const Question& question) const;

  const ColumnSource& source_;
  QueryUnits units_;
  ParameterColumns parameters_;
  std::vector<double> x_values_, y_values_;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::size_t> ascending_;  ///< positions in the order of the numbers
  std::vector<Status> statuses_;
};

}  // namespace portrait
