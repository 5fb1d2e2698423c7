/// One closed loop of any rational plant and controller: what the papers compare, beyond the families of loop.h.
///
///     w --> F(s) --r--> | u = (N_r(s) r - N_y(s) y)/D(s) |--> u --> (+ d) --> P(s) e^{-Td s} --> (+ o) --> y
///                       |         <--------------------- y ---------------------------------------------+
///
///     P    plant       any proper rational function, unstable or not; Td >= 0
///     D    controller  with N_r = N_y one degree of freedom; other N_r are setpoint weights [Kos2021 (5.1)]
///     F    prefilter   any proper, stable rational function
///
/// N_y may be of one degree more than D: the ideal derivative of the measured output.
/// unit      any consistent set: times in that of Td, gains in input per output; `normalised` leads in
#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/loop/forms.h"
#include "engine/loop/loop.h"
#include "engine/loop/open_loop.h"
#include "engine/loop/transfer_function.h"
#include "engine/loop/units.h"

namespace portrait {

struct GeneralPlant {
  TransferFunction rational;
  double dead_time = 0;
};

struct GeneralController {
  Polynomial on_setpoint;               ///< N_r
  Polynomial on_output;                 ///< N_y
  std::vector<Polynomial> denominator;  ///< D, in factors
  TransferFunction prefilter;           ///< F
};

struct GeneralLoop {
  GeneralPlant plant;
  GeneralController controller;
};

/// Why this loop cannot be simulated, and what to do: an improper part, an algebraic loop, a hidden unstable mode.
std::optional<std::string> why_invalid(const GeneralLoop& loop);

/// A loop of the normalised families, for everything that takes a general one. REQUIRES: the loop is valid.
GeneralLoop general(const Loop& loop);

/// L(s) = P(s) N_y(s)/D(s) e^{-Td s}, in the unit of time of the loop. REQUIRES: the loop is valid.
OpenLoop open_loop(const GeneralLoop& loop);

/// C(s) = N(s)/D(s) acting on r - y. REQUIRES: C is proper.
GeneralController controller(const TransferFunction& C);

/// (Kp + Ki/s + Kd s)/(Tf s + 1)^n on r - y for n >= 1; for n = 0 with the ideal derivative of the output.
GeneralController pid_controller(const ParallelForm& form, int n = 0, double Tf = 0);

/// (K_-1/s + K_0 + K_1 s + ... + K_m s^m)/(1 + Tf s)^n, gains from K_-1 up.                    [HO-PID (1)]
/// REQUIRES: n >= m = gains.size() - 2; at least one gain is not 0.
GeneralController gains_controller(std::span<const double> gains, int n, double Tf);

/// The same controller with weights on the setpoint: u = b P r + I r + c D r - (P + I + D) y.      [Kos2021 (5.1)]
/// REQUIRES: of degree 2 or less in N_y over s (...), as the two above make them with m <= 1.
GeneralController with_weights(GeneralController controller, double b, double c);

/// Times this many of the old ones: s is measured per `unit`.
GeneralLoop in_time_unit(const GeneralLoop& loop, double unit);

/// Dead time 1 (or 0), plant gain 1: the first coefficient of s^k P(s) that is not 0.
struct NormalisedLoop {
  GeneralLoop loop;
  Units units;
};
/// Without dead time the unit of time is `unit_without_dead_time`, or else that of `usual_time_unit`.
/// REQUIRES: the loop is valid.
NormalisedLoop normalised(const GeneralLoop& loop, std::optional<double> unit_without_dead_time = std::nullopt);

/// The dead time; without one the sum of the plant's time constants 1/|p|, or else 1 over the gain crossover.
double usual_time_unit(const GeneralLoop& loop);

}  // namespace portrait
