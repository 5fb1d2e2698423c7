#include "portraits/query/query_units.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/query/grid_values.h"

namespace portrait {
namespace {

[[noreturn]] void fail(const std::string& message) { throw InputError(Place{"plant"}, message); }

void require_plant(const RealPlant& plant) {
  const std::string_view lag = lag_name(plant.family);
  if (!lag.empty() && plant.T1 == 0)
    fail(fmt::format("{} is missing: a {} plant has K, Td and {}", lag, to_string(plant.family), lag));
  if (lag.empty() && plant.T1 != 0)
    fail(fmt::format("T1 belongs to fotd; a {} plant has K and Td", to_string(plant.family)));
  if (const auto why = why_invalid(plant)) fail(*why);
}

std::optional<std::vector<double>> axis_values(const Grid& grid, Parameter parameter) {
  for (const Axis& axis : grid.axes)
    if (axis.parameter() == parameter) return axis.values();
  return std::nullopt;
}

void require_lag(const RealPlant& plant, const Grid& grid) {
  const Parameter lag = lag_parameter(plant.family).value();
  const double value = plant.T1 / plant.Td;
  const std::string name = fmt::format("{}/Td", lag_name(plant.family));
  const auto values = axis_values(grid, lag);
  if (values && !index_of_value(*values, value))
    fail(fmt::format("{} is {}, which is no value of the axis {} (nearest: {})", name, number_text(value),
                     to_string(lag), nearest_values(*values, value)));
  for (const FixedParameter& fixed : grid.fixed)
    if (fixed.parameter == lag && !same_number(fixed.value, value))
      fail(fmt::format("{} is {}, but {} is {} in the whole portrait", name, number_text(value), to_string(lag),
                       number_text(fixed.value)));
}

void require_step(const char* name, double size) {
  if (!std::isfinite(size) || size <= 0)
    throw InputError(Place{"step"},
                     fmt::format("{} must be finite and above 0 (it is {})", name, number_text(size)));
}

double size_of_step(char step, const StepSizes& steps) { return step == 'w' ? steps.w : step == 'd' ? steps.d : 1; }

/// The power of the step's size that a measure grows with.
int power_of_step(Unit unit) {
  switch (unit) {
    case Unit::output:
    case Unit::output_time:
    case Unit::output_time2:
    case Unit::input:
      return 1;
    case Unit::output2_time:
    case Unit::output2_time2:
      return 2;
    default:
      return 0;
  }
}

std::string_view words(Unit unit) {
  switch (unit) {
    case Unit::one:
      return "a pure number";
    case Unit::degree:
      return "degrees";
    case Unit::time:
      return "time";
    case Unit::per_time:
      return "radians per time";
    case Unit::output:
      return "unit of y";
    case Unit::output_time:
      return "unit of y times time";
    case Unit::output_time2:
      return "unit of y times time squared";
    case Unit::output2_time:
      return "unit of y squared times time";
    case Unit::output2_time2:
      return "unit of y squared times time squared";
    case Unit::input:
      return "unit of u";
    case Unit::input_per_output:
      return "unit of u per unit of y";
  }
  return {};
}

std::string step_text(char step, const StepSizes& steps) {
  const std::string_view kind = step == 'w' ? "setpoint" : step == 'd' ? "input disturbance" : "output disturbance";
  return fmt::format(", for a step of {} in the {}", number_text(size_of_step(step, steps)), kind);
}

std::string text_of(Measure measure, const QueryUnits& units, const Grid&) {
  const MeasureInfo& about = info(measure);
  if (about.unit == Unit::one || about.unit == Unit::degree) return std::string(words(about.unit));
  const bool has_step = power_of_step(about.unit) > 0 && about.step != '-';
  return fmt::format("{}{}", units.plant ? fmt::format("real, {}", words(about.unit)) : "normalised",
                     has_step ? step_text(about.step, units.steps) : "");
}

std::string text_of(Parameter parameter, const QueryUnits&, const Grid& grid) {
  return fmt::format("normalised, {}", normalisation(parameter, grid.family.plant));
}

std::string text_of(ControllerValue value, const QueryUnits&, const Grid&) {
  switch (value) {
    case ControllerValue::Kc:
      return "real, unit of u per unit of y";
    case ControllerValue::Ki:
      return "real, unit of u per unit of y and time";
    case ControllerValue::Kd:
      return "real, unit of u per unit of y, times time";
    default:
      return "real, time";
  }
}

}  // namespace

double factor(Measure measure, const QueryUnits& units) {
  const MeasureInfo& about = info(measure);
  const double real = units.plant ? scale(measure, *units.plant) : 1;
  return real * std::pow(size_of_step(about.step, units.steps), power_of_step(about.unit));
}

void require_fits(const QueryUnits& units, const Grid& grid) {
  require_step("w", units.steps.w);
  require_step("d", units.steps.d);
  if (!units.plant) return;
  if (has_gains(grid.family))
    fail("a portrait of gains is asked in normalised numbers: its parameters' attribute `normalisation` leads out");
  const RealPlant& plant = *units.plant;
  if (plant.family != grid.family.plant)
    fail(fmt::format("it is {}, but the portrait's plant is {}", to_string(plant.family),
                     to_string(grid.family.plant)));
  require_plant(plant);
  if (lag_parameter(plant.family)) require_lag(plant, grid);
}

std::optional<double> slice_of(const QueryUnits& units, const Grid& grid) {
  const auto lag = lag_parameter(grid.family.plant);
  if (!lag || !units.plant) return std::nullopt;
  const auto values = axis_values(grid, *lag);
  if (!values) return std::nullopt;
  return values->at(index_of_value(*values, units.plant->T1 / units.plant->Td).value());
}

std::string unit_text(Quantity quantity, const QueryUnits& units, const Grid& grid) {
  return std::visit([&](auto q) { return text_of(q, units, grid); }, quantity);
}

}  // namespace portrait
