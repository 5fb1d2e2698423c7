/// Controllers for plants with one integrator by the magnitude optimum, with a weight b on the setpoint.   [Kos2021]
///
///     PI    u = b Kp r + (Ki/s)(r - y) - Kp y                                                       [Kos2021 (4.1)]
///     PID   u = (b Kp r + Ki (r - y)/s + b Kd s r - Kp y - Kd s y)/(1 + Tf s)                       [Kos2021 (5.1)]
///
/// |G_CL(jw)| = 1 to as high an order in w as the gains allow; from the areas A_0, A_1, ... of s G_P(s) alone, with the
/// filter in them for PID. b = 0 serves disturbances, b -> 1 setpoints.
/// unit      those of the areas
/// domain    0 <= b < 1, and b = 1 for P and PD without integral action
/// accuracy  rounding, against the published tables and ten-digit targets: tests/engine/rules/kos2021_test.cpp
///
/// Departures: Kp of (4.6) is computed as 1/(A_1 + sign(A_1) sqrt(A_1^2 + xi)), the same without cancellation and for
/// plants of negative gain. (4.9), (3.8) and (5.34) are misprinted and not used as printed: docs/reproductions.md.
#pragma once

#include <array>
#include <optional>

#include "engine/loop/forms.h"
#include "engine/rules/areas.h"

namespace portrait::rules {

/// (4.4), (4.6)-(4.8); nothing when Kp would be complex. REQUIRES: 3 areas, A_0 and A_1 not 0, 0 <= b <= 1.
std::optional<ParallelForm> integrating_pi(const Areas& areas, double b);

/// Average residence time of the closed loop, (1 - b) Kp/Ki; for b = 1 1/(A_0 Kp).          [Kos2021 (4.23), (4.24)]
double residence_time(const Areas& areas, const ParallelForm& form, double b);

/// The PI of a wanted residence time.                                                   [Kos2021 (4.26), (4.28), (4.4)]
ParallelForm integrating_pi_of_speed(const Areas& areas, double b, double residence_time);

/// (5.10)-(5.13) with the largest positive root of the quartic (5.11); nothing when there is none.
/// REQUIRES: 5 areas with the filter, A_0 not 0, 0 <= b < 1.
std::optional<ParallelForm> integrating_pid(const Areas& with_filter, double b);

/// Kp and Kd for b = 1; nothing when A_1 A_2 = A_0 A_3.                                              [Kos2021 (5.14)]
std::optional<ParallelForm> integrating_pd(const Areas& with_filter);

/// Beyond this residence time there is no PID, only PI (b < 1) or P (b = 1).                  [Kos2021 (5.22), (5.25)]
double slowest_pid(const Areas& with_filter, double b);

/// The PID of a wanted residence time, or the PI or P it turns into.                          [Kos2021 (5.23)-(5.27)]
std::optional<ParallelForm> integrating_pid_of_speed(const Areas& with_filter, double b, double residence_time);

/// b_F1, b_F2 of the numerator of the second-order reference filter, which gives a PID with b = 0 the setpoint
/// response of the PD loop.                                                                    [Kos2021 (5.30), (5.31)]
/// Areas with the filter, against Remark 5.4: only so do the published values come out.
std::array<double, 2> reference_filter_2(const Areas& with_filter, const ParallelForm& pid, const ParallelForm& pd);

/// K_M (1 + b_1 s) e^{-Td s}/(s (1 + a_1 s + a_2 s^2)).                                              [Kos2021 (3.2)]
struct AreaModel {
  double K, b1, Td, a1, a2;
};

/// b_F1 .. b_F5 of the reference filter of higher order, for a model of the plant without the filter. [Kos2021 (5.43)]
std::array<double, 5> reference_filter_5(const AreaModel& model, const ParallelForm& pid, double Tf);

}  // namespace portrait::rules
