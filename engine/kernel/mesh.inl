/// The panels of a dead time and what is prepared for each: weights of integration, solvers of the lags.
#pragma once

#include "engine/kernel/plant.inl"
#include "engine/kernel/prefilter.inl"

namespace portrait::PORTRAIT_ISA_NAME {

struct Panel {
  double start, half;  ///< of the panel in its dead time; half its length
  IntegralWeights weights;
  Lag filter, plant;
  Prefilter prefilter;
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

inline void join(Output& to, const Output& left, const Output& right) {
  set_joined(to.y, left.y, right.y);
  set_joined(to.y1, left.y1, right.y1);
  set_joined(to.y2, left.y2, right.y2);
  set_joined(to.y3, left.y3, right.y3);
}

inline void copy(Output& to, const Output& from) {
  copy(to.y, from.y), copy(to.y1, from.y1), copy(to.y2, from.y2), copy(to.y3, from.y3);
}

/// The outputs of a graded mesh on the same mesh with `graded` = 0: the two shortest blocks become one, again and again.
inline void flatten(const kernel::Mesh& mesh, Output* outputs) {
  const int parts = 1 << mesh.halved;
  int panels = panels_of(mesh);
  Output joined;
  for (int g = 0; g < mesh.graded; ++g, panels -= parts) {
    for (int i = 0; i < parts; ++i) {
      join(joined, outputs[2 * i], outputs[2 * i + 1]);
      copy(outputs[i], joined);
    }
    for (int i = parts; i < panels - parts; ++i) copy(outputs[i], outputs[i + parts]);
  }
}

}  // namespace portrait::PORTRAIT_ISA_NAME
