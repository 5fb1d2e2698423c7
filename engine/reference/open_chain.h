/// The loop cut open at the dead time: an ordinary linear system driven by signals that are already known.
///
/// On the interval [k, k + 1] of time the measured output y(t) = z(t - 1) comes from the interval before, z
/// being the output of the delay-free plant. What is left to solve is
///
///     x' = A x + B q + E v                 x  states of prefilter, filter, integrator and plant
///     p  = C x + D q + F v                 p  = (z, z', u)
///     q(t) = (z, z')(t - 1),               v  = (w, d, o), constant
///     y  = z(t - 1) + o
///
/// y' is needed by the ideal derivative of the output (n = 0) only. Then D is not zero for ipdt and fotd: z'
/// depends on y' at once, the loop is neutral, and jumps of z' come back after every dead time. A step o of the
/// output would be an impulse of y', which is left out: responses to it do not exist with the ideal derivative.
/// unit      normalised: time in dead times, plant gain 1
#pragma once

#include <Eigen/Core>

#include "engine/loop/general_loop.h"
#include "engine/loop/loop.h"
#include "engine/loop/steady_state.h"

namespace portrait::reference {

/// Rows of p, columns of B and D (z and z' delayed are y and y'), columns of E and F.
enum Output { kZ = 0, kSlope = 1, kU = 2, kOutputs = 3 };
enum Delayed { kY = 0, kYSlope = 1, kDelayed = 2 };
enum Step { kSetpoint = 0, kDisturbance = 1, kOutputStep = 2, kSteps = 3 };

struct OpenChain {
  Eigen::MatrixXd A, B, E;
  Eigen::MatrixXd C, D, F;
  double fastest;  ///< shortest time constant of the chain, in dead times; inf without any

  Eigen::Index states() const { return A.rows(); }
};

/// REQUIRES: the loop is valid.
OpenChain open_chain(const Loop& loop);
/// Factor after factor of each part of the loop; every factor's states are its output and that output's slopes.
OpenChain open_chain(const GeneralLoop& loop);

/// Where the closed loop comes to rest, if it is stable, after a unit step.
template <typename AnyLoop>
SteadyState steady_state(const AnyLoop& loop, Step step) {
  return step == kSetpoint      ? rest_after_setpoint_step(loop)
         : step == kDisturbance ? rest_after_disturbance_step(loop)
                                : rest_after_output_step(loop);
}

}  // namespace portrait::reference
