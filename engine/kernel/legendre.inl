/// Smooth signals on a panel of time as Legendre series, a lane each.
///
///     f(x) = sum_k c_k P_k(x),  -1 <= x <= 1,  k = 0 .. kDegree
///
/// Legendre rather than Chebyshev: the integral of f is 2 c_0, that of f^2 a sum of squares, integration is two entries
/// a row, and |P_k| <= 1 gives the same cheap test that f has no zero.
#pragma once

#include "engine/kernel/lanes.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr int kDegree = 12;
inline constexpr int kTerms = kDegree + 1;

struct Series {
  Lanes c[kTerms];
};

/// f at x, by Clenshaw's sum: (k + 1) P_{k+1} = (2k + 1) x P_k - k P_{k-1}.
inline Lanes value(const Series& f, Lanes x) {
  Lanes b1 = 0.0, b2 = 0.0;
  for (int k = kDegree; k >= 1; --k) {
    const double alpha = (2.0 * k + 1) / (k + 1), beta = -(k + 1.0) / (k + 2);
    const Lanes b0 = mul_add(Lanes(alpha) * x, b1, mul_add(Lanes(beta), b2, f.c[k]));
    b2 = b1;
    b1 = b0;
  }
  return mul_add(x, b1, mul_add(Lanes(-0.5), b2, f.c[0]));
}

inline Lanes value_at_start(const Series& f) {
  Lanes even = f.c[0], odd = f.c[1];
  for (int k = 2; k < kTerms; k += 2) even += f.c[k];
  for (int k = 3; k < kTerms; k += 2) odd += f.c[k];
  return even - odd;
}

inline Lanes value_at_end(const Series& f) {
  Lanes sum = f.c[0];
  for (int k = 1; k < kTerms; ++k) sum += f.c[k];
  return sum;
}

/// Sum of |c_k| from k = `from` on: f without its first terms is nowhere larger.
inline Lanes rest_bound(const Series& f, int from) {
  Lanes a = abs(f.c[from]), b = abs(f.c[from + 1]);
  for (int k = from + 2; k < kTerms; k += 2) a += abs(f.c[k]);
  for (int k = from + 3; k < kTerms; k += 2) b += abs(f.c[k]);
  return a + b;
}

/// start + (h/2) int_{-1}^x f: int P_k = (P_{k+1} - P_{k-1})/(2k + 1). The term of degree kDegree + 1 is dropped.
inline Series integral(const Series& f, Lanes half_length, Lanes start) {
  Series scaled, g;
  for (int k = 0; k < kTerms; ++k) scaled.c[k] = f.c[k] * (half_length * Lanes(1.0 / (2 * k + 1)));
  g.c[0] = start + (scaled.c[0] - scaled.c[1]);
  for (int k = 1; k < kDegree; ++k) g.c[k] = scaled.c[k - 1] - scaled.c[k + 1];
  g.c[kDegree] = scaled.c[kDegree - 1];
  return g;
}

/// d/dx f.
inline Series derivative(const Series& f) {
  Series d;
  d.c[kDegree] = 0.0;
  d.c[kDegree - 1] = Lanes(2.0 * kDegree - 1) * f.c[kDegree];
  Lanes above = d.c[kDegree - 1], above2 = 0.0;  // d_k/(2k+1) = c_{k+1} + d_{k+2}/(2k+5)
  for (int k = kDegree - 2; k >= 0; --k) {
    d.c[k] = Lanes(2.0 * k + 1) * mul_add(above2, Lanes(1.0 / (2 * k + 5)), f.c[k + 1]);
    above2 = above;
    above = d.c[k];
  }
  return d;
}

/// Exact smallest and largest value of c_0 + c_1 x + c_2 P_2(x) on [-1, 1].
struct Extent {
  Lanes low, high;
};

inline Extent parabola_extent(Lanes c0, Lanes c1, Lanes c2) {
  const Lanes left = c0 - c1 + c2, right = c0 + c1 + c2;
  // Vertex at x = -c1/(3 c2), inside when |c1| < 3 |c2|, with value c0 - c2/2 - c1^2/(6 c2).
  const Mask inside = abs(c1) < Lanes(3.0) * abs(c2);
  const Lanes vertex = c0 - Lanes(0.5) * c2 - c1 * c1 / (Lanes(6.0) * select(inside, c2, Lanes(1.0)));
  const Lanes inner = select(inside, vertex, left);
  return {min(min(left, right), inner), max(max(left, right), inner)};
}

/// Lanes in which f certainly has no zero: its parabola keeps further from 0 than the other terms can reach.
inline Mask has_no_zero(const Series& f) {
  const Lanes rest = rest_bound(f, 3);
  const Extent e = parabola_extent(f.c[0], f.c[1], f.c[2]);
  return (e.low > rest) | (-e.high > rest);
}

/// A cheaper and weaker form of the same: |c_0| against all other terms.
inline Mask clearly_has_no_zero(const Series& f) { return abs(f.c[0]) > rest_bound(f, 1); }

/// P_k((x - 1)/2) = sum_j left[k][j] P_j(x): f on the left half of its panel, as a series of its own; on the right half the
/// signs alternate. Lower triangular.
struct HalvingTable {
  double left[kTerms][kTerms];
};

constexpr HalvingTable make_halving_table() {
  // Columns by the recurrence of P_k with argument (x - 1)/2, using x P_j = ((j+1) P_{j+1} + j P_{j-1})/(2j+1).
  HalvingTable t{};
  t.left[0][0] = 1;
  t.left[1][0] = -0.5;
  t.left[1][1] = 0.5;
  for (int k = 1; k + 1 < kTerms; ++k) {
    double shifted[kTerms + 1] = {};
    for (int j = 0; j <= k; ++j) {
      shifted[j + 1] += t.left[k][j] * (j + 1) / (2 * j + 1);
      if (j > 0) shifted[j - 1] += t.left[k][j] * j / (2 * j + 1);
    }
    for (int j = 0; j <= k + 1; ++j) {
      const double here = j <= k ? t.left[k][j] : 0, before = j <= k - 1 ? t.left[k - 1][j] : 0;
      t.left[k + 1][j] = ((2 * k + 1) * 0.5 * (shifted[j] - here) - k * before) / (k + 1);
    }
  }
  return t;
}

inline constexpr HalvingTable kHalving = make_halving_table();

inline Series left_half(const Series& f) {
  Series g;
  for (int j = 0; j < kTerms; ++j) {
    Lanes sum = 0.0;
    for (int k = j; k < kTerms; ++k) sum = mul_add(f.c[k], Lanes(kHalving.left[k][j]), sum);
    g.c[j] = sum;
  }
  return g;
}

inline Series right_half(const Series& f) {
  Series g;
  for (int j = 0; j < kTerms; ++j) {
    Lanes sum = 0.0;
    for (int k = j; k < kTerms; ++k) {
      const double sign = (k + j) % 2 == 0 ? 1 : -1;
      sum = mul_add(f.c[k], Lanes(sign * kHalving.left[k][j]), sum);
    }
    g.c[j] = sum;
  }
  return g;
}

/// Solver of tau v' + v = e on a panel, a tridiagonal system in the coefficients of v' (Galerkin, kDegree + 1 terms):
///
///     (tau + h/2) w_0 - (h/6) w_1 = e_0 - v(start),   (h/2)(w_{j-1}/(2j-1) - w_{j+1}/(2j+3)) + tau w_j = e_j
///
/// All pivots exceed tau: nothing cancels, however small tau is.
struct Lag {
  Lanes tau;
  Lanes lower[kTerms], inverse[kTerms], upper[kTerms];

  void prepare(Lanes time_constant, Lanes half_length) {
    tau = time_constant;
    Lanes pivot = tau + half_length;
    inverse[0] = Lanes(1.0) / pivot;
    upper[0] = half_length * Lanes(1.0 / 3) * inverse[0];
    for (int j = 1; j < kTerms; ++j) {
      lower[j] = half_length * Lanes(1.0 / (2 * j - 1)) * inverse[j - 1];
      const Lanes above = half_length * Lanes(1.0 / (2 * j + 1));
      pivot = mul_add(lower[j], above, tau);
      inverse[j] = Lanes(1.0) / pivot;
      upper[j] = half_length * Lanes(1.0 / (2 * j + 3)) * inverse[j];
    }
  }

  /// v' for the input e from v(start).
  Series slope(const Series& e, Lanes start) const {
    Series w;
    w.c[0] = e.c[0] - start;
    for (int j = 1; j < kTerms; ++j) w.c[j] = mul_sub_from(lower[j], w.c[j - 1], e.c[j]);
    w.c[kDegree] = w.c[kDegree] * inverse[kDegree];
    for (int j = kDegree - 1; j >= 0; --j) w.c[j] = mul_add(upper[j], w.c[j + 1], w.c[j] * inverse[j]);
    return w;
  }
};

}  // namespace portrait::PORTRAIT_ISA_NAME
