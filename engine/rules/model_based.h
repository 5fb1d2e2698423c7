/// Controllers jR^m by a target for the closed loop, for plants of j equal lags and a dead time.
///
///     plant   K e^{-Td s}/(Tj s + 1)^j          target  e^{-Td s}/(Tc s + 1)^i,  i = max(j, 1)     [Huba2021 (34), (53)]
///     R(s) = (Tj s + 1)^j D(s)/(K ((Tc s + 1)^i D(s) - N(s)))                                       [Huba2021 (2), (55)]
///
/// e^{-Td s} = N/D in the denominator: Taylor 1 - Td s, or a Pade quotient of order 1 or 2, which raises the order of the
/// controller by as much: (6), (11), (14) for j = 1; (21), (24) for j = 2; (28); (32); (72)-(74) for j = 0. The constant
/// terms cancel, so R has its integrator, and it is proper.
/// unit      those of the plant
/// domain    j = 0 .. 8, Td > 0 or, for j >= 1, Td = 0; Tc > 0 (j = 0: the time constant T_f of the filter)
#pragma once

#include "engine/loop/polynomial.h"

namespace portrait::rules {

enum class DeadTimeQuotient { taylor, pade_1, pade_2 };

struct LagPlant {
  int j;
  double K, Tj, Td;
};

struct Quotient {
  Polynomial numerator, denominator;  ///< lowest power first; the denominator begins with a 0
};

Quotient model_based_controller(const LagPlant& plant, double Tc, DeadTimeQuotient quotient);

/// ((Tc s + 1)/(Tj s + 1))^j, with which u is a step after a setpoint step.                           [Huba2021 (56)]
Quotient step_prefilter(const LagPlant& plant, double Tc);
/// 1/(Tj s + 1)^order: the smoother, the higher the order, at most j.                    [Huba2021 (67)-(69), (95), (97)]
Quotient smooth_prefilter(const LagPlant& plant, int order);

/// (1 + T s)^n, written out.
Polynomial lag_power(double T, int n);

}  // namespace portrait::rules
