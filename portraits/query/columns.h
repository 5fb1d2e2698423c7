/// Columns of a block of settings: what expressions are evaluated over.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/loop/parameters.h"
#include "engine/measures/catalogue.h"

namespace portrait {

/// What a name in an expression can mean.
using Quantity = std::variant<Measure, Parameter>;

std::string_view to_string(Quantity quantity);
std::optional<Quantity> quantity_named(std::string_view name);
/// All names, measures first.
std::vector<std::string_view> quantity_names();

/// One array per quantity, of which only those in use are filled; all filled ones have `count` values.
class Columns {
 public:
  std::size_t count = 0;

  std::vector<double>& operator[](Quantity quantity) { return values_[position(quantity)]; }
  const std::vector<double>& operator[](Quantity quantity) const { return values_[position(quantity)]; }

 private:
  static std::size_t position(Quantity quantity);
  std::array<std::vector<double>, kMeasureCount + kParameterCount> values_;
};

}  // namespace portrait
