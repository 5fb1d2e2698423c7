/// The plant of a family that answers a recorded input most like the record, by least squares.
///
///     y(t) = level + drift (t - t_0) + K g(t; Td, T1),   g the family's answer to u - u(0) with K = 1
///
/// K, level and drift are linear and solved exactly; Td and T1 are searched, on a grid first and then from its best point.
/// The input is taken as held between samples and enters without error.
/// unit      those of the record
/// accuracy  a record without noise gives its plant back to 1e-6: tests/engine/records/plant_fit_test.cpp
/// cost      some hundred passes over the record
#pragma once

#include <string>

#include "engine/loop/real_plant.h"
#include "engine/records/record.h"

namespace portrait::records {

struct PlantFit {
  RealPlant plant;
  double level, drift;
  double residual;  ///< root of the mean square of what the model leaves of y
  double share;     ///< of the mean square of y about its own line
  Quality quality;
  std::vector<std::string> remarks;
};

/// `with_drift`: y may have run away before the change already. Throws InputError when nothing of the family fits: the model
/// explains less than half of y.
PlantFit fitted_plant(const Record& record, Plant family, bool with_drift);

/// The steepest line through the record, per unit of a step: slope and lag behind the change.    [Dalen2018 6]
struct MeasuredReactionCurve {
  double slope, lag;
  double window;  ///< over which the slope is fitted
};
/// Throws InputError unless u is one step.
MeasuredReactionCurve measured_reaction_curve(const Record& record);

}  // namespace portrait::records
