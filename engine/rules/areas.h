/// Characteristic areas: the Maclaurin coefficients of a plant, which magnitude-optimum tuning needs and nothing else of it.
///
///     G_P(s) = (A_0 - A_1 s + A_2 s^2 - ...)/s^k,   k = 0 or 1                             [HO-PID (6), Kos2021 (2.7)]
///
/// shape     A[0], A[1], ... as many as asked for
/// unit      A_i in output per input times time^i
/// accuracy  rounding: tests/engine/rules/areas_test.cpp
#pragma once

#include <vector>

#include "engine/loop/polynomial.h"

namespace portrait::rules {

using Areas = std::vector<double>;

/// Of N(s)/D(s) e^{-Td s}, the integrators left out of D.                       [HO-PID (7), Kos2021 (2.8)]
/// REQUIRES: D(0) != 0.
Areas areas_of(const Polynomial& numerator, const Polynomial& denominator, double dead_time, std::size_t count);

/// The same with a filter 1/(1 + Tf s)^n behind the plant.                                                [HO-PID (8)]
Areas filtered(Areas areas, double Tf, int n);

}  // namespace portrait::rules
