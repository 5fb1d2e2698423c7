/// The field's usual comparisons, as formulas: SIMC and iSIMC, Ziegler-Nichols, Tyreus-Luyben, IMC, AMIGO.
///
/// k e^{-tau s}/s is the plant of the integrating ones, K e^{-tau s}/(T s + 1) that of the others.
/// unit      those of the plant
#pragma once

#include "engine/loop/forms.h"
#include "engine/rules/delta_tuning.h"

namespace portrait::rules {

struct LagDelayPlant {
  double K, T, tau;
};

/// PI. Kp = T/(K (Tc + tau)), Ti = min(T, 4 (Tc + tau)).                      [Skogestad2003, Dalen2018 (13), (14)]
StandardForm simc_pi(const LagDelayPlant& plant, double Tc);
StandardForm simc_pi(const IntegratingPlant& plant, double Tc);
/// Series PID of K e^{-tau s}/((T s + 1)(T2 s + 1)): the PI above and TD = T2.             [Skogestad2003, Huba2021 (77)]
SeriesForm simc_pid(const LagDelayPlant& plant, double T2, double Tc);
/// Series PID of k e^{-tau s}/s^2: Kc = 1/(4 k (Tc + tau)^2), Ti = TD = 4 (Tc + tau).                     [Skogestad2003]
SeriesForm simc_double_integrator(double k, double tau, double Tc);

/// Improved SIMC: series PID with TD = tau/3, and the PI that takes tau/3 into its lag.               [Grimholt2018]
SeriesForm isimc_pid(const LagDelayPlant& plant, double Tc);
SeriesForm isimc_pid(const IntegratingPlant& plant, double Tc);
StandardForm isimc_pi(const LagDelayPlant& plant, double Tc);

/// PI, Kp = (2 Tc + tau)/(k (Tc + tau)^2), Ti = 2 Tc + tau.                                        [Chien1990]
StandardForm imc_pi(const IntegratingPlant& plant, double Tc);

/// Gain and period at which a proportional controller makes the loop oscillate for ever.
struct Ultimate {
  double gain, period;
};
Ultimate ultimate(const IntegratingPlant& plant);  ///< pi/(2 k tau), 4 tau
Ultimate ultimate(const LagDelayPlant& plant);
StandardForm ziegler_nichols_pi(const Ultimate& u);   ///< Ku/2.2, Pu/1.2                       [ZieglerNichols1942]
StandardForm ziegler_nichols_pid(const Ultimate& u);  ///< 0.6 Ku, Pu/2, Pu/8                   [ZieglerNichols1942]
StandardForm tyreus_luyben_pi(
    const Ultimate& u);  ///< Ku/3.2, 2.2 Pu                             [TyreusLuyben1992]
StandardForm tyreus_luyben_pid(
    const Ultimate& u);  ///< Ku/2.2, 2.2 Pu, Pu/6.3                     [TyreusLuyben1992]

/// Robust step-response rules.                                                              [AstromHagglund2006, ch. 7]
StandardForm amigo_pi(const LagDelayPlant& plant);
StandardForm amigo_pi(const IntegratingPlant& plant);
StandardForm amigo_pid(const LagDelayPlant& plant);
StandardForm amigo_pid(const IntegratingPlant& plant);

}  // namespace portrait::rules
