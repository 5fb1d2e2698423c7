/// What is timed: boxes of settings around a known good one, every loop stable, filter 1/(tau_f s + 1), b = c = 0,
/// horizon 51.
///
///     dipdt-pid        QRDP, kappa = 0.1248, delta = 0.5045, tau_i = 10.324           [Huba2022 (22)]
///     dipdt-pid-fast   the same box, tau_f = 0.01 in place of 0.1
///     ipdt-pi          SIMC with Tc = Td, kappa = 0.5, tau_i = 8                      [Dalen2018 (14)]
///     ipdt-pid         the same with a derivative, delta = 0.2
///     fotd-pi          pole cancellation with Tc = Td, kappa = tau_1/2, tau_i = tau_1; tau_1 = 2
///                                                                                     [Dalen2018 (13)]
#pragma once

#include <string>
#include <vector>

#include "grids/grid.h"

namespace portrait::bench {

struct Case {
  std::string name;
  Grid grid;
  std::vector<Setting> settings;
  /// Of the batched step loop. Fifty steps a dead time do not resolve tau_f = 0.01; the case keeps them all the
  /// same, so that the engine is measured against the cheapest loop that anyone would run.
  double batched_tolerance = 1e-4;
};

/// 3,200 settings each.
std::vector<Case> cases();

/// The same with few settings, from all over each box.
std::vector<Case> few_of_each(const std::vector<Case>& all);

/// About `count` settings (at least 128) of the box of dipdt-pid, for sweeps of any length.
Grid sweep_grid(std::uint64_t count);

/// All but noise_gain, which asks for a sampling time: what the engine computes while it is timed.
std::vector<Measure> timed_measures();

}  // namespace portrait::bench
