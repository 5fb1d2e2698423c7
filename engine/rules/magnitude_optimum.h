/// Controllers with derivatives up to any order m for self-regulating plants, by the magnitude optimum.
///
///     C(s) = (K_-1/s + K_0 + K_1 s + ... + K_m s^m)/(1 + Tf s)^n                                         [HO-PID (1)]
///
/// The m + 2 gains make Re L(jw) = -1/2 up to as high a power of w as they can, a linear system in the areas A_0 ..
/// A_{2m+3} of the plant with the filter behind it.                                               [HO-PID (14)-(17)]
/// domain    m = 0: PI, m = 1: PID, m = 2: PIDA, ...
/// accuracy  that of the linear solver, against the condition of the areas: tests/engine/rules/ho_pid_test.cpp
#pragma once

#include <cstddef>
#include <optional>

#include "engine/rules/areas.h"

namespace portrait::rules {

/// 2m + 4, A_0 to A_{2m+3}. REQUIRES: m >= 0
constexpr std::size_t areas_for_order(int m) { return 2 * static_cast<std::size_t>(m) + 4; }

/// K_-1, K_0, ..., K_m from areas with the filter in them; nothing when the system is singular: the controller could cancel
/// the whole plant, and no finite gain is optimal. REQUIRES: `areas_for_order` areas.
std::optional<std::vector<double>> magnitude_optimum(const Areas& with_filter, int m);

struct NoiseGainDesign {
  double Tf;
  std::vector<double> gains;
};

/// Tf such that u carries K_HF times the power of white measurement noise sampled with Ts, gains and Tf in turn until
/// both rest (Figure 5).                                                                             [HO-PID (32)]
/// Nothing when a system on the way is singular or they do not come to rest. REQUIRES: n >= m, and n > m or m >= 1.
std::optional<NoiseGainDesign> magnitude_optimum_for_noise_gain(const Areas& plant, int m, int n, double K_HF,
                                                                double Ts);

}  // namespace portrait::rules
