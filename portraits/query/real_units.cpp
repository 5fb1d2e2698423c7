#include "portraits/query/real_units.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/grid_values.h"

namespace portrait {
namespace {

[[noreturn]] void fail(const std::string& message) { throw InputError(Place{"plant"}, message); }

void require_plant(const RealPlant& plant) {
  if (plant.family == Plant::fotd && plant.T1 == 0) fail("T1 is missing: a fotd plant has K, Td and T1");
  if (plant.family != Plant::fotd && plant.T1 != 0)
    fail(fmt::format("T1 belongs to fotd; a {} plant has K and Td", to_string(plant.family)));
  if (const auto why = why_invalid(plant)) fail(*why);
}

std::optional<std::vector<double>> axis_values(const Grid& grid, Parameter parameter) {
  for (const Axis& axis : grid.axes)
    if (axis.parameter() == parameter) return axis.values();
  return std::nullopt;
}

void require_tau_1(double tau_1, const Grid& grid) {
  const auto values = axis_values(grid, Parameter::tau_1);
  if (values && !index_of_value(*values, tau_1))
    fail(fmt::format("T1/Td is {}, which is no value of the axis tau_1 (nearest: {})", number_text(tau_1),
                     nearest_values(*values, tau_1)));
  for (const FixedParameter& fixed : grid.fixed)
    if (fixed.parameter == Parameter::tau_1 && !same_number(fixed.value, tau_1))
      fail(fmt::format("T1/Td is {}, but tau_1 is {} in the whole portrait", number_text(tau_1),
                       number_text(fixed.value)));
}

}  // namespace

RealUnits::RealUnits(const ColumnSource& source, const RealPlant& plant) : source_(source) {
  for (const Measure measure : all_measures()) scales_[static_cast<std::size_t>(measure)] = scale(measure, plant);
}

void RealUnits::read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const {
  source_.read(measure, first, count, values);
  const double factor = scales_[static_cast<std::size_t>(measure)];
  for (double& value : values) value *= factor;
}

void require_fits(const RealPlant& plant, const Grid& grid) {
  if (plant.family != grid.family.plant)
    fail(fmt::format("it is {}, but the portrait's plant is {}", to_string(plant.family),
                     to_string(grid.family.plant)));
  require_plant(plant);
  if (plant.family == Plant::fotd) require_tau_1(plant.T1 / plant.Td, grid);
}

std::optional<double> slice_of(const RealPlant& plant, const Grid& grid) {
  const auto values = axis_values(grid, Parameter::tau_1);
  if (!values) return std::nullopt;
  return values->at(index_of_value(*values, plant.T1 / plant.Td).value());
}

}  // namespace portrait
