/// Solvers of the prefilter's denominators, of first and of second order, driven by a constant.
#pragma once

#include "engine/kernel/legendre.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// a2 x'' + a1 x' + x = 1 on a panel: x' and x'' as sums of what comes from 1 - x and from x' at the panel's start.
///
/// The coefficients of (x'', x') are coupled to their neighbours by integration, (h/2)(f_{k-1}/(2k-1) - f_{k+1}/(2k+3)), and
/// the start appears in the first equations alone, so each pair is a 2 x 2 matrix times the pair before it.
struct Oscillator {
  Series x2_of_missing, x2_of_slope, x1_of_missing, x1_of_slope;

  void prepare(Lanes a1, Lanes a2, double half_length) {
    Matrix ratio[kTerms + 1];
    ratio[kTerms] = {Lanes(0.0), Lanes(0.0), Lanes(0.0), Lanes(0.0)};
    for (int k = kDegree; k >= 1; --k) ratio[k] = next_ratio(a1, a2, half_length, k, ratio[k + 1]);
    Matrix product = inverse(equations(a1, a2, half_length, 0, ratio[1]));
    set(0, product);
    for (int k = 1; k < kTerms; ++k) {
      product = times(ratio[k], product);
      set(k, product);
    }
  }

 private:
  struct Matrix {
    Lanes a, b, c, d;  ///< rows (a b), (c d)
  };

  static Matrix times(const Matrix& m, const Matrix& n) {
    return {m.a * n.a + m.b * n.c, m.a * n.b + m.b * n.d, m.c * n.a + m.d * n.c, m.c * n.b + m.d * n.d};
  }
  static Matrix inverse(const Matrix& m) {
    const Lanes scale = Lanes(1.0) / (m.a * m.d - m.b * m.c);
    return {m.d * scale, -(m.b * scale), -(m.c * scale), m.a * scale};
  }

  /// x' - int x'' = x' at the start and a2 x'' + a1 x' + int x' = 1 - x at the start, of the k-th coefficients, with those of
  /// k + 1 put in.
  static Matrix equations(Lanes a1, Lanes a2, double half, int k, const Matrix& above) {
    const Lanes up = half / (2 * k + 3), own = k == 0 ? half : 0.0;
    return {up * above.a - own, mul_add(up, above.b, Lanes(1.0)), mul_sub_from(up, above.c, a2),
            mul_sub_from(up, above.d, a1 + own)};
  }

  static Matrix next_ratio(Lanes a1, Lanes a2, double half, int k, const Matrix& above) {
    const Lanes down = half / (2 * k - 1);
    return times(inverse(equations(a1, a2, half, k, above)), {down, Lanes(0.0), Lanes(0.0), -down});
  }

  /// Columns of the solution: the right-hand sides are x' and 1 - x at the start.
  void set(int k, const Matrix& m) {
    x2_of_slope[k] = m.a;
    x2_of_missing[k] = m.b;
    x1_of_slope[k] = m.c;
    x1_of_missing[k] = m.d;
  }
};

/// One of the two, as the pack says.
struct Prefilter {
  Lag lag;
  Oscillator oscillator;
};

}  // namespace portrait::PORTRAIT_ISA_NAME
