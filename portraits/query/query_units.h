/// The units in which a question is asked: those of a real plant and of steps of a given size, or normalised ones.
///
/// With a plant every measure is the measure of the real loop, and so are the values of the controller; parameters keep
/// meaning the normalised numbers of the grid. Steps of another size than one scale y and u of their responses, with or
/// without a plant: linear measures by the size, those of squared errors by its square, margins not at all.
/// equation  engine/loop/real_plant.h                                                    [Huba2022, after (47)]
/// accuracy  1e-8 against a simulation in real units: tests/portraits/query/real_simulation_test.cpp
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "engine/loop/real_plant.h"
#include "grids/grid.h"
#include "portraits/query/columns.h"
#include "portraits/query/expression.h"

namespace portrait {

/// Sizes of the steps in the setpoint and in the disturbance at the plant input, in the units of w and u.
struct StepSizes {
  double w = 1;
  double d = 1;
};

struct QueryUnits {
  std::optional<RealPlant> plant;
  StepSizes steps;
};

/// A measure of the portrait times this is the measure in these units.
double factor(Measure measure, const QueryUnits& units);

/// One formula for numbers and for intervals: `of(parameter)` gives either.
template <typename Number, typename Of>
Number controller_value(ControllerValue value, const RealPlant& plant, Of of) {
  const auto constant = [](double number) {
    if constexpr (std::is_same_v<Number, double>)
      return number;
    else
      return Number::of(number);
  };
  const Number gain = constant(input_gain(plant)), Td = constant(plant.Td);
  switch (value) {
    case ControllerValue::Kc:
      return of(Parameter::kappa) / gain;
    case ControllerValue::Ti:
      return of(Parameter::tau_i) * Td;
    case ControllerValue::TD:
      return of(Parameter::tau_d) * Td;
    case ControllerValue::Ki:
      return of(Parameter::kappa) / gain / (of(Parameter::tau_i) * Td);
    case ControllerValue::Kd:
      return of(Parameter::delta) * Td / gain;
    case ControllerValue::Tf:
      return of(Parameter::tau_f) * Td;
  }
  return constant(kNaN);
}

/// Throws InputError when a step has no size, when the plant cannot be, is of another family than the portrait's, or has
/// a T1/Td that the portrait does not hold.
void require_fits(const QueryUnits& units, const Grid& grid);

/// The value on the axis tau_1 that is T1/Td within 1e-9; nothing when tau_1 is no axis or there is no plant.
/// REQUIRES: require_fits.
std::optional<double> slice_of(const QueryUnits& units, const Grid& grid);

/// What the numbers of a quantity are: "real: unit of y times time, for a setpoint step of 2", "normalised: Kc K Td".
std::string unit_text(Quantity quantity, const QueryUnits& units, const Grid& grid);

}  // namespace portrait
