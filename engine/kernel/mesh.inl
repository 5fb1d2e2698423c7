/// The panels of a dead time and what is prepared for each: weights of integration, solvers of the lags.
#pragma once

#include "engine/kernel/legendre.inl"
#include "engine/kernel/pack.h"

namespace portrait::PORTRAIT_ISA_NAME {

struct Panel {
  double start, half;  ///< of the panel in its dead time; half its length
  IntegralWeights weights;
  Lag filter, plant;

  /// Another panel of the same length has the same solvers, of those that are in use.
  void solve_as(const Panel& other, bool with_filter, bool with_plant) {
    half = other.half;
    weights = other.weights;
    if (with_filter) filter = other.filter;
    if (with_plant) plant = other.plant;
  }
};

/// Lengths of the panels of a mesh, from left to right. `lengths` holds panels_of(mesh).
inline void cut(const kernel::Mesh& mesh, double* lengths) {
  double block = 1;
  for (int g = 0; g < mesh.graded; ++g) block *= 0.5;
  const int parts = 1 << mesh.halved;
  for (int b = 0; b <= mesh.graded; ++b) {
    for (int i = 0; i < parts; ++i) *lengths++ = block / parts;
    if (b > 0) block *= 2;
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
