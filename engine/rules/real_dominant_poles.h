/// PD and PID for a double integrator with dead time, by where the real dominant poles of the loop shall lie.
///
///     PID   p^3 e^p + k_i + kappa p + delta p^2 = 0   at four real poles,   k_i = kappa/tau_i       [Huba2022 (28)]
///     PD    p^2 e^p + kappa + delta p = 0             at a triple real pole                         [Huba2022 (10)]
///
/// The four poles are p_o and p_o/m, each as often as the set says: (29), (33), (37), and (21) for m = 1. At them the
/// quadratic -(k_i + kappa p + delta p^2) interpolates g(p) = p^3 e^p, so p_o is where the divided difference of g over
/// all four vanishes, one equation in one unknown whatever m is. Divided differences come from a matrix function of
/// the nodes (Opitz' formula), which has no trouble with poles that coincide or nearly do; the paper takes powers of an
/// equation instead, with computer algebra, for each m anew.
///
/// unit      dead time 1, plant gain 1
/// domain    any m > 0; of several solutions the one nearest to 0
/// accuracy  the quasi-polynomial and its derivatives vanish at the poles to 1e-13: tests/engine/rules/
#pragma once

#include <array>
#include <optional>

#include "engine/loop/loop.h"

namespace portrait::rules {

/// How often p_o is a pole; p_o/m makes up the four.
enum class PoleSet {
  one_modified = 3,    ///< p_o three times, p_o/m once                                           [Huba2022 (29)]
  two_modified = 2,    ///< each twice                                                            [Huba2022 (33)]
  three_modified = 1,  ///< p_o once, p_o/m three times                                           [Huba2022 (37)]
};

struct RealPolesTuning {
  double p_o;  ///< per dead time, below 0; T_o = -1/p_o
  double kappa, delta, tau_i;
};

/// REQUIRES: m is finite and above 0. Nothing when no solution lies within 1000 of the usual size.
std::optional<RealPolesTuning> four_real_poles(PoleSet set, double m);

/// [Huba2022 (13)-(15)], where (14) lacks a factor sqrt(2) in K_do. tau_i = inf.
RealPolesTuning triple_real_pole();

/// p^3 e^p + k_i + kappa p + delta p^2 and its first three derivatives, which a multiple pole makes 0.
std::array<double, 4> quasi_polynomial(const RealPolesTuning& tuning, double p);

}  // namespace portrait::rules
