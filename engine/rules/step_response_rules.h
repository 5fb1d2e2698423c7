/// Rules the thesis compares with, from the literature it takes them from: its tables print their results alone.
///
///     kappa-tau   from a plant's tangent: intercept L and T = gain/slope of the step response of s G_P, for Ms 1.4 or 2
///                                                                                            [AstromHagglund1995]
///     Taguchi     two-degree-of-freedom PI and PID by fitted formulas in x = L/T                  [TaguchiAraki2000]
///
/// unit      those of the plant; K is the velocity gain
/// domain    one integrator; Taguchi: 0, 1 or 2 equal lags besides
#pragma once

#include <optional>

#include "engine/loop/forms.h"
#include "engine/loop/polynomial.h"

namespace portrait::rules {

/// With weights b and c of the setpoint in the proportional and the derivative part.
struct WeightedPid {
  StandardForm form;
  double b, c;
};

struct Tangent {
  double L, T;
};

/// Of N(s)/D(s) e^{-Td s}, the plant without its integrator: reaction_curve.h. T = 0 when it is the dead time alone.
/// Nothing when it has no steepest tangent. REQUIRES: N/D is 1 or strictly proper, N(0) and D(0) not 0.
std::optional<Tangent> steepest_tangent(const Polynomial& numerator, const Polynomial& denominator, double Td);

WeightedPid kappa_tau_pi(double K, const Tangent& tangent, bool Ms_2);
WeightedPid kappa_tau_pid(double K, const Tangent& tangent, bool Ms_2);

/// K e^{-L s}/(s (1 + T s)^lags), lags = 0, 1, 2. The published K_P is per K T; the thesis' tables forgot to divide by T.
WeightedPid taguchi_pi(double K, double L, double T, int lags);
WeightedPid taguchi_pid(double K, double L, double T, int lags);

}  // namespace portrait::rules
