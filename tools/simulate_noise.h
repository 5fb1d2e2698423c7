/// Measurement noise on the loop of `portrait simulate`: mean and spread over seeds, beside what is expected.
#pragma once

#include <array>

#include "engine/loop/general_loop.h"
#include "engine/reference/noise.h"
#include "tools/output.h"
#include "tools/simulate_arguments.h"

namespace portrait::tools {

/// Sizes of the steps w, d, o in the units of the line.
using Sizes = std::array<double, reference::kSteps>;

/// {"kind", "amplitude", "sampling", "controller", "seeds", "noise_gain", "sigma_ratio": {...}, "w": {"TV_u": {"mean",
/// "spread"}, ...}, "d": {...}} in the units of the line. Throws InputError.
Json noise_report(const SimulateArguments& a, const NormalisedLoop& inside, const Sizes& sizes);
std::string noise_text(const Json& report);

}  // namespace portrait::tools
