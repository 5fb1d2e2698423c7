/// All measures of one loop, by the reference simulation: definitions taken literally, nothing sampled.
///
/// Extremes are sign changes of y' and u'; integrals of the error are taken in error_integrals.h. The error is that
/// of the simulation.
#pragma once

#include <optional>
#include <span>

#include "engine/base/status.h"
#include "engine/loop/general_loop.h"
#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"
#include "engine/reference/response.h"

namespace portrait::reference {

struct Measured {
  Status status = Status::not_computed;
  MeasureRow measures;  ///< all NaN when unstable
  double horizon = 0;   ///< dead times really simulated; 0 when unstable
};

/// `sampling` in dead times, for noise_gain, which is NaN without it. REQUIRES: the loop is valid.
Measured measure(const Loop& loop, Horizon horizon, const Accuracy& accuracy = {},
                 std::optional<double> sampling = std::nullopt, std::span<const Step> steps = kUsualSteps);

/// The same of a general loop, normalised, without noise_gain. REQUIRES: the loop is valid and normalised.
Measured measure(const GeneralLoop& loop, Horizon horizon, const Accuracy& accuracy = {},
                 std::span<const Step> steps = kUsualSteps);

/// What `loop` does in its own units of time, input and output: simulated normalised, scaled back. Frequencies are per its
/// unit of time, DM in it; steps have size one in its units.
struct MeasuredInUnits {
  Measured measured;
  Units units;
};
/// A fixed `horizon` is in units of time of the loop. REQUIRES: the loop is valid, in any units.
MeasuredInUnits measure_in_units(const GeneralLoop& loop, Horizon horizon,
                                 std::span<const Step> steps = kUsualSteps);

/// The same from a response at hand. REQUIRES: `response` is that of a stable `loop`.
Measured measure(const Loop& loop, const Response& response, std::optional<double> sampling = std::nullopt);

}  // namespace portrait::reference
