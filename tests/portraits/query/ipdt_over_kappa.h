/// A small grid for tests that measure its settings themselves: ipdt with n = 1 over kappa, everything else fixed.
#pragma once

#include <utility>
#include <vector>

#include "grids/grid.h"

namespace portrait {

inline Grid ipdt_over_kappa(double horizon, std::vector<Measure> measures) {
  Grid grid;
  grid.family = {Plant::ipdt, 1, Prefilter::full};
  grid.horizon = Horizon::fixed(horizon);
  grid.measures = std::move(measures);
  grid.axes = {Axis::linear(Parameter::kappa, 0.2, 1, 9)};
  grid.fixed = {{Parameter::tau_i, 6},
                {Parameter::delta, 0.1},
                {Parameter::tau_f, 0.1},
                {Parameter::b, 0},
                {Parameter::c, 0}};
  return grid;
}

/// One of its settings, or between them.
inline Setting with_kappa(double kappa) { return {.kappa = kappa, .tau_i = 6, .delta = 0.1, .tau_f = 0.1}; }

}  // namespace portrait
