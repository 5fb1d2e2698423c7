/// A model with one integrator, two lags, a zero and a dead time that has the same first areas as the plant. [Kos2021 3]
///
/// unit      those of the areas
/// accuracy  exact plants of the form come back to 1e-6 or better, worse where roots coincide:
///           tests/engine/rules/area_model_test.cpp
/// Departure: (3.8) and (5.34) print +A_3/A_0; the model's own areas need -A_3/A_0.
#pragma once

#include <optional>

#include "engine/rules/integrating_magnitude_optimum.h"

namespace portrait::rules {

/// Four parameters, b_1 = 0: the smallest dead time that (3.8) allows; nothing when none is real and not below 0.
/// REQUIRES: 4 areas, A_0 not 0.
std::optional<AreaModel> model_without_zero(const Areas& areas);

/// Five parameters, the dead time given.                                                          [Kos2021 (5.33)]
AreaModel model_with_dead_time(const Areas& areas, double dead_time);

/// Five parameters, the dead time found too; `minimum_phase` chooses where two models fit (3.12).
/// REQUIRES: 5 areas. Nothing when the flowchart of Figure 3.1 ends without a model.
std::optional<AreaModel> model_with_zero(const Areas& areas, bool minimum_phase);

}  // namespace portrait::rules
