/// PI controllers on the Pareto front of setpoint and disturbance responses, at a prescribed peak of sensitivity.
///
///     minimise   J = s_r IAE_vy/IAE_vy^o + (1 - s_r) IAE_vu/IAE_vu^o     over Kp, Ti with Ms = Ms_pre     [Dalen2018 (41), (46)]
///
/// IAE_vy, IAE_vu: unit steps at the plant's output and input; IAE^o are their least values at the same Ms, for an
/// integrating plant that of the P controller where the setpoint is concerned, for with integral action IAE_vy jumps.
/// method    along curves of constant method product cbar = Kp Ti k the gain that has Ms_pre is found by bisection; J is then a
///           smooth function of log cbar, whose derivative is taken over five points and set to 0
/// unit      whatever the given loop is in
/// accuracy  Ms 1e-9, Kp and Ti 1e-6 relative: tests/engine/rules/pareto_pi_test.cpp
/// cost      about 150 simulations
#pragma once

#include <functional>
#include <optional>

#include "engine/rules/field.h"

namespace portrait::rules {

struct PiErrors {
  double IAE_vy, IAE_vu;
};

/// A plant under PI control, as the search sees it.
struct PiLoop {
  std::function<double(double Kp, double Ti)> Ms;        ///< inf when unstable
  std::function<PiErrors(double Kp, double Ti)> errors;  ///< NaN where an integral does not exist
  IntegratingPlant scale;                                ///< k and tau about which cbar and delta are measured
  bool integrating;
};

PiLoop pi_loop(const IntegratingPlant& plant);
PiLoop pi_loop(const LagDelayPlant& plant);

struct ParetoPi {
  double Kp, Ti;
  double cbar, J;
  PiErrors errors, least;  ///< of the optimum; IAE^o
};

/// Nothing when no PI has this Ms. REQUIRES: Ms > 1, 0 <= s_r <= 1 (< 1 on an integrating plant).
std::optional<ParetoPi> pareto_pi(const PiLoop& loop, double Ms, double s_r);

/// The same with J's weights IAE^o given, as those of another Ms: points of one front for one J. `least` is `reference`.
std::optional<ParetoPi> pareto_pi(const PiLoop& loop, double Ms, double s_r, const PiErrors& reference);

/// Kp and Ti with this Ms on a curve of constant cbar (inf: P control); nothing when there are none.
std::optional<StandardForm> pi_of_sensitivity(const PiLoop& loop, double cbar, double Ms);

}  // namespace portrait::rules
