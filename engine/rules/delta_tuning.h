/// PI for an integrator with dead time by the delay margin it shall have (Algorithm 1), and the method product.
///
///     cbar = alpha beta = Kp Ti k,   Kp = alpha/(k tau),   Ti = beta tau                         [Dalen2018 (2), (3)]
///     f = (1 + sqrt(1 + 4/cbar^2))/2,   a = arctan(sqrt(f) cbar)/sqrt(f)                         [Dalen2018 (16), (19)]
///     alpha = a/(delta + 1),   beta = (cbar/a)(delta + 1)                                        [Dalen2018 (21), (22)]
///
/// delta tau is the exact delay margin, whatever cbar; dtau_max = delta tau says the same without dividing by tau, so
/// that tau = 0 is a plant too.
/// unit      those of the plant: Kp in input per output, Ti in time
/// accuracy  closed forms: tests/engine/rules/dalen2018_test.cpp
#pragma once

#include "engine/loop/forms.h"

namespace portrait::rules {

/// k e^{-tau s}/s; k of either sign.
struct IntegratingPlant {
  double k, tau;
};

/// f and a of the head; cbar > 0.
double method_product_f(double cbar);
double method_product_a(double cbar);

/// Kp = a/(k (dtau_max + tau)), Ti = (cbar/a)(dtau_max + tau).                                   [Dalen2018 (26)-(29)]
StandardForm delta_tuning_by_margin(const IntegratingPlant& plant, double cbar, double dtau_max);
/// The same with dtau_max = delta tau. REQUIRES: tau > 0.                                         [Dalen2018 (23), (24)]
StandardForm delta_tuning(const IntegratingPlant& plant, double cbar, double delta);

/// delta of a given PI loop.                                                                      [Dalen2018 (18)]
double relative_delay_margin(double alpha, double beta);

/// Three equal poles tau_0 = c tau of the loop with e^{-tau s} as a (2,1) Pade quotient: c = 1.7385 solves (37) and makes
/// them three; other c keep (34) and (36).                                                   [Dalen2018 (38)-(40)]
StandardForm pade_tuning(const IntegratingPlant& plant, double c);
/// The real positive root of (37), 1.73848...
double pade_triple_root();

}  // namespace portrait::rules
