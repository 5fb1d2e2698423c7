/// The measured output on a panel, that of the plant one dead time before, with the derivatives that are known.
///
///     dipdt  y'' = u + d        ipdt  y' = u + d        fotd  tau_1 y' + y = u + d      (u, d, of one dead time before)
#pragma once

#include "engine/kernel/pack.h"
#include "engine/kernel/sums.inl"

namespace portrait::PORTRAIT_ISA_NAME {

struct Output {
  Series y, y1, y2, y3;    ///< y and derivatives: three of dipdt, two of the others
  Series u, u1;            ///< of fotd; the others have u + d and u' among the derivatives of y
  Lanes rest, slope_rest;  ///< at least the sums of |c_k|, k >= 1, of y and y1
  ErrorSums sums;          ///< of y

  void begin() {
    set_zero(y), set_zero(y1), set_zero(y2), set_zero(y3);
    sum_up();
  }
  /// From now on series end at `degree`.
  void cut_at(int degree) {
    Series* const all[] = {&y, &y1, &y2, &y3, &u, &u1};
    for (Series* const f : all) set_zero_above(*f, degree);
  }
  void sum_up() {
    rest = rest_bound(y, 1);
    slope_rest = rest_bound(y1, 1);
    sums = error_sums_of(y);
  }
};

template <kernel::PlantKind kind>
Series& plant_input(Output& z) {
  return kind == kernel::PlantKind::dipdt ? z.y2 : kind == kernel::PlantKind::ipdt ? z.y1 : z.u;
}
template <kernel::PlantKind kind>
Series& plant_input_slope(Output& z) {
  return kind == kernel::PlantKind::dipdt ? z.y3 : kind == kernel::PlantKind::ipdt ? z.y2 : z.u1;
}

/// The outputs of a graded mesh on the same mesh with `graded` = 0: the two shortest blocks become one, again and again. Of y
/// and its derivatives, as many as are asked for.
class Flattening {
 public:
  explicit Flattening(int derivatives) : rows_(derivatives + 1) {}

  void flatten(const kernel::Mesh& mesh, Output* outputs) {
    const int parts = 1 << mesh.halved;
    int panels = panels_of(mesh);
    double half = 0.5 / parts;  // of the panels that come out
    for (int g = 1; g < mesh.graded; ++g) half *= 0.5;
    for (int g = 0; g < mesh.graded; ++g, panels -= parts, half *= 2) {
      for (int i = 0; i < parts; ++i) join(outputs[i], outputs[2 * i], outputs[2 * i + 1], half);
      for (int i = parts; i < panels - parts; ++i) move(outputs[i], outputs[i + parts]);
    }
    for (int i = 0; i < parts; ++i) outputs[i].sum_up();
  }

 private:
  static Series& row(Output& z, int i) {
    Series* const rows[] = {&z.y, &z.y1, &z.y2, &z.y3};
    return *rows[i];
  }

  /// The highest derivative is joined, the others are its integrals.
  void join(Output& to, Output& left, Output& right, double half) {
    int i = rows_ - 1;
    set_joined(row(to, i), row(left, i), row(right, i));
    for (--i; i >= 0; --i) {
      const Lanes mean = Lanes(0.5) * (row(left, i)[0] + row(right, i)[0]);
      set_integral(row(to, i), row(to, i + 1), half, mean);
    }
  }

  void move(Output& to, Output& from) {
    for (int i = 0; i < rows_; ++i) copy(row(to, i), row(from, i));
    to.rest = from.rest, to.slope_rest = from.slope_rest;
    to.sums = from.sums;
  }

  int rows_;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
