/// The reference simulation: the responses of one loop to unit steps, by the method of steps.
///
/// Slow, scalar and general, and the judge of every faster path. One dead time after the other, the measured
/// output is the plant's output of the interval before, so each interval is an ordinary linear system with a
/// known input, solved by collocation on a few panels. Every discontinuity lies on a multiple of the dead
/// time and hence on a panel's edge. A panel on which a signal's Chebyshev coefficients have not died out is
/// halved and the run starts over: the result is resolved everywhere, or the simulation fails loudly.
///
/// unit      time in dead times, u and y normalised
/// accuracy  integrals of the error 1e-9, TV 1e-7 relative, for tau_f and tau_1 down to 1e-4:
///           tests/engine/reference/
/// cost      some linear maps a panel, made once, and a few small matrix products a panel and dead time
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/reference/chebyshev.h"
#include "engine/reference/open_chain.h"

namespace portrait::reference {

/// y and u on [start, start + length], as Chebyshev series of x = 2 (t - start)/length - 1.
struct Piece {
  double start;
  double length;
  Series y, u;
};

/// The answer to one step.
struct StepResponse {
  std::vector<Piece> pieces;  ///< without gaps from 0 to the horizon; y and u may jump at an edge
  SteadyState at_rest;        ///< the exact limits as t -> inf of a stable loop
  double y_noise = 0;         ///< how far rounding alone may move y
  double u_noise = 0;         ///< the same for u
};

struct Response {
  std::array<StepResponse, kSteps> steps;  ///< by Step; without pieces where a step was not simulated
  double horizon = 0;                      ///< in dead times
  double last_from = 0;                    ///< from here on a settled response lies within its band
  bool quiet = false;                      ///< an automatic horizon was long enough, see `simulate`
};

struct Accuracy {
  int stages = 14;           ///< degree of the polynomials
  int least_panels = 1;      ///< panels of equal length that a dead time is cut into at least
  double tolerance = 1e-11;  ///< of a signal's largest value, for its last coefficients; inf: never refine
};

/// What a portrait needs.
inline constexpr std::array<Step, 2> kUsualSteps = {kSetpoint, kDisturbance};
inline constexpr std::array<Step, 3> kAllSteps = {kSetpoint, kDisturbance, kOutputStep};

/// The responses to some steps. An automatic horizon ends when the deviations from rest, going on as they decayed
/// over the last half of the run, would change no integral by more than 1e-10 of its value; at kHorizonCap it
/// gives up and `quiet` is false. A loop that grows beyond 1e12 of its step is ended there.
/// REQUIRES: the loop is valid; for an automatic horizon also stable.
Response simulate(const Loop& loop, Horizon horizon, const Accuracy& accuracy = {},
                  std::span<const Step> steps = kUsualSteps);

/// The same of a general loop, normalised: its dead time is 1, or 0. Without dead time the loop is an ordinary linear
/// system, taken from panel to panel by its matrix exponential; panels are halved and doubled as the responses need.
/// REQUIRES: as above; the loop is normalised.
Response simulate(const GeneralLoop& loop, Horizon horizon, const Accuracy& accuracy = {},
                  std::span<const Step> steps = kUsualSteps);

/// The signal at one instant (the limit from the right at an edge). REQUIRES: 0 <= t <= horizon.
double y_at(const StepResponse& response, double t);
double u_at(const StepResponse& response, double t);

}  // namespace portrait::reference
