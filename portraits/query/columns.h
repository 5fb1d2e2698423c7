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

/// A number of the controller in the units of a real plant: standard form Kc (1 + 1/(Ti s) + TD s), gains Ki = Kc/Ti
/// and Kd = Kc TD of the parallel form, filter time constant. Only a question with a plant has them.
enum class ControllerValue { Kc, Ti, TD, Ki, Kd, Tf };
inline constexpr std::array<std::string_view, 6> kControllerValueNames = {"Kc", "Ti", "TD", "Ki", "Kd", "Tf"};
constexpr std::string_view to_string(ControllerValue value) {
  return kControllerValueNames[static_cast<std::size_t>(value)];
}

/// What a name in an expression can mean.
using Quantity = std::variant<Measure, Parameter, ControllerValue>;
inline constexpr std::size_t kQuantityCount = kMeasureCount + kParameterCount + kControllerValueNames.size();
/// 0 .. kQuantityCount - 1.
std::size_t position(Quantity quantity);

std::string_view to_string(Quantity quantity);
std::optional<Quantity> quantity_named(std::string_view name);
/// All names, measures first, then parameters.
std::vector<std::string_view> quantity_names();

/// One array per quantity, of which only those in use are filled; all filled ones have `count` values.
class Columns {
 public:
  std::size_t count = 0;

  std::vector<double>& operator[](Quantity quantity) { return values_[position(quantity)]; }
  const std::vector<double>& operator[](Quantity quantity) const { return values_[position(quantity)]; }

 private:
  std::array<std::vector<double>, kQuantityCount> values_;
};

}  // namespace portrait
