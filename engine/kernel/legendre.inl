/// Smooth signals on a panel of time as Legendre series, a lane each.
///
///     f(x) = sum_k c_k P_k(x),  -1 <= x <= 1,  k = 0 .. kDegree
///
/// Legendre rather than Chebyshev: the integral of f is 2 c_0, that of f^2 a sum of squares, integration is two entries
/// a row, and |P_k| <= 1 gives the same cheap test that f has no zero. A series fills many registers: every function
/// writes where it is told, and none returns or copies one unasked.
#pragma once

#include "engine/kernel/lanes.inl"

namespace portrait::PORTRAIT_ISA_NAME {

inline constexpr int kDegree = 12;
inline constexpr int kTerms = kDegree + 1;
/// Of responses whose fast parts have decayed: higher coefficients are then zero.
inline constexpr int kSmoothDegree = 8;

struct Series {
  Lanes c[kTerms];

  Series() = default;
  Series(const Series&) = delete;
  Series& operator=(const Series&) = delete;

  Lanes& operator[](int k) { return c[k]; }
  const Lanes& operator[](int k) const { return c[k]; }
};

inline void set_zero(Series& f) {
  for (Lanes& c : f.c) c = Lanes(0.0);
}

inline void set_zero_above(Series& f, int degree) {
  for (int k = degree + 1; k < kTerms; ++k) f[k] = Lanes(0.0);
}

/// to = a f
inline void set_scaled(Series& to, Lanes a, const Series& f) {
  for (int k = 0; k < kTerms; ++k) to[k] = a * f[k];
}

inline void add_scaled(Series& to, Lanes a, const Series& f) {
  for (int k = 0; k < kTerms; ++k) to[k] = mul_add(a, f[k], to[k]);
}

inline void copy(Series& to, const Series& f) {
  for (int k = 0; k < kTerms; ++k) to[k] = f[k];
}

/// f at both ends: the even terms less the odd ones, and with them.
struct Ends {
  Lanes left, right;
};

template <int degree = kDegree>
inline Ends ends_of(const Series& f) {
  Lanes even = f[0], odd = f[1];
  for (int k = 2; k <= degree; k += 2) even += f[k];
  for (int k = 3; k <= degree; k += 2) odd += f[k];
  return {even - odd, even + odd};
}

inline Lanes value_at_start(const Series& f) { return ends_of(f).left; }
inline Lanes value_at_end(const Series& f) { return ends_of(f).right; }

/// Calls use(k, P_k(x)) for k = 0 .. last: (k + 1) P_{k+1} = (2k + 1) x P_k - k P_{k-1}.
template <int last, typename Use>
inline void for_each_polynomial(Lanes x, Use use) {
  Lanes before = 1.0, here = x;
  use(0, before);
  use(1, here);
  for (int k = 1; k < last; ++k) {
    const double alpha = (2.0 * k + 1) / (k + 1), beta = static_cast<double>(k) / (k + 1);
    const Lanes next = mul_sub_from(Lanes(beta), before, (Lanes(alpha) * x) * here);
    use(k + 1, next);
    before = here;
    here = next;
  }
}

inline Lanes value(const Series& f, Lanes x) {
  Lanes sum = 0.0;
  for_each_polynomial<kDegree>(x, [&](int k, Lanes P) { sum = mul_add(f[k], P, sum); });
  return sum;
}

/// Sum of |c_k| from k = `from` on: f without its first terms is nowhere larger.
template <int degree = kDegree>
inline Lanes rest_bound(const Series& f, int from) {
  Lanes a = abs(f[from]), b = abs(f[from + 1]);
  for (int k = from + 2; k <= degree; k += 2) a += abs(f[k]);
  for (int k = from + 3; k <= degree; k += 2) b += abs(f[k]);
  return a + b;
}

/// 1/(2k + 1)
struct OddReciprocals {
  double odd[kTerms + 1];
};
constexpr OddReciprocals make_odd_reciprocals() {
  OddReciprocals t{};
  for (int k = 0; k <= kTerms; ++k) t.odd[k] = 1.0 / (2 * k + 1);
  return t;
}
inline constexpr OddReciprocals kOneOver = make_odd_reciprocals();

/// h/(2 (2k + 1)) for a panel h long: what integration takes of every term, int P_k = (P_{k+1} - P_{k-1})/(2k + 1).
struct IntegralWeights {
  double of[kTerms];
  void prepare(double half_length) {
    for (int k = 0; k < kTerms; ++k) of[k] = half_length * kOneOver.odd[k];
  }
};

/// to = d/dx f.
template <int degree = kDegree>
inline void set_derivative(Series& to, const Series& f) {
  // d_k/(2k+1) = c_{k+1} + d_{k+2}/(2k+5)
  Lanes even = 0.0, odd = 0.0;
  to[degree] = 0.0;
  for (int k = degree - 1; k >= 0; --k) {
    Lanes& sum = k % 2 == 0 ? even : odd;
    sum += f[k + 1];
    to[k] = Lanes(2.0 * k + 1) * sum;
  }
}

/// to = the integral of f over a panel, with f_0 = mean.
inline void set_integral(Series& to, const Series& f, Lanes half, Lanes mean) {
  to[0] = mean;
  for (int k = 1; k < kTerms; ++k) {
    const Lanes below = Lanes(1.0 / (2 * k - 1)) * f[k - 1];
    to[k] = half * (k < kDegree ? mul_sub_from(Lanes(1.0 / (2 * k + 3)), f[k + 1], below) : below);
  }
}

/// to = x f: x P_k = ((k+1) P_{k+1} + k P_{k-1})/(2k + 1), what exceeds kDegree dropped. One degree more than f has.
template <int degree = kDegree>
inline void set_times_x(Series& to, const Series& f) {
  to[0] = f[1] * Lanes(1.0 / 3);
  for (int k = 1; k <= degree + 1 && k <= kDegree; ++k) {
    const Lanes from_below = f[k - 1] * Lanes(static_cast<double>(k) / (2 * k - 1));
    to[k] = k < degree ? mul_add(f[k + 1], Lanes((k + 1.0) / (2 * k + 3)), from_below) : from_below;
  }
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
template <int degree = kDegree>
inline Mask has_no_zero(const Series& f) {
  const Lanes rest = rest_bound<degree>(f, 3);
  const Extent e = parabola_extent(f[0], f[1], f[2]);
  return (e.low > rest) | (-e.high > rest);
}

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

template <int degree = kDegree>
inline void set_left_half(Series& to, const Series& f) {
  for (int j = 0; j <= degree; ++j) {
    Lanes sum = 0.0;
    for (int k = j; k <= degree; ++k) sum = mul_add(f[k], Lanes(kHalving.left[k][j]), sum);
    to[j] = sum;
  }
}

template <int degree = kDegree>
inline void set_right_half(Series& to, const Series& f) {
  for (int j = 0; j <= degree; ++j) {
    Lanes sum = 0.0;
    for (int k = j; k <= degree; ++k) {
      const double sign = (k + j) % 2 == 0 ? 1 : -1;
      sum = mul_add(f[k], Lanes(sign * kHalving.left[k][j]), sum);
    }
    to[j] = sum;
  }
}

/// to = the polynomial nearest in the mean to `left` and `right`, the halves of one panel: the transpose of halving, with
/// the norms of P_k between. `to` may be one of them.
inline void set_joined(Series& to, const Series& left, const Series& right) {
  Lanes even[kTerms], odd[kTerms];  // halves of an even function agree here, of an odd one there
  for (int k = 0; k < kTerms; ++k) {
    const double weight = 0.5 / (2 * k + 1);
    even[k] = Lanes(weight) * (left[k] + right[k]);
    odd[k] = Lanes(weight) * (left[k] - right[k]);
  }
  for (int j = 0; j < kTerms; ++j) {
    Lanes a = 0.0, b = 0.0;
    for (int k = j; k >= 0; k -= 2) a = mul_add(even[k], Lanes((2 * j + 1) * kHalving.left[j][k]), a);
    for (int k = j - 1; k >= 0; k -= 2) b = mul_add(odd[k], Lanes((2 * j + 1) * kHalving.left[j][k]), b);
    to[j] = a + b;
  }
}

/// to = f on [-1, end] of its panel, as a series of its own: Clenshaw's sum with series in place of numbers.
inline void set_cut_off(Series& to, const Series& f, double end) {
  const Lanes half = 0.5 * (end + 1), center = 0.5 * (end - 1);
  Series rows[3], moved;
  Series *b0 = &rows[0], *b1 = &rows[1], *b2 = &rows[2];
  set_zero(*b1);
  set_zero(*b2);
  const auto at_argument = [&](Series& s, const Series& g) {
    set_times_x(moved, g);
    set_scaled(s, center, g);
    add_scaled(s, half, moved);
  };
  for (int k = kDegree; k >= 1; --k) {
    at_argument(*b0, *b1);
    for (Lanes& c : b0->c) c = c * Lanes((2.0 * k + 1) / (k + 1));
    add_scaled(*b0, Lanes(-(k + 1.0) / (k + 2)), *b2);
    (*b0)[0] += f[k];
    Series* const spare = b2;
    b2 = b1;
    b1 = b0;
    b0 = spare;
  }
  at_argument(to, *b1);
  add_scaled(to, Lanes(-0.5), *b2);
  to[0] += f[0];
}

/// Solver of tau v' + v = e on a panel, a tridiagonal system in the coefficients of v' (Galerkin, degree + 1 terms):
///
///     (tau + h/2) w_0 - (h/6) w_1 = e_0 - v(start),   (h/2)(w_{j-1}/(2j-1) - w_{j+1}/(2j+3)) + tau w_j = e_j
///
/// All pivots exceed tau: nothing cancels, however small tau is.
struct Lag {
  Lanes lower[kTerms], inverse[kTerms], upper[kTerms];

  /// A pivot is the ratio of two determinants, D_j = tau D_{j-1} + h^2/(4 (4 j^2 - 1)) D_{j-2}: none has to wait for another
  /// one's division. They are taken of the system by tau + h/2, so that none is too large for a number.
  void prepare(Lanes tau, double half_length) {
    const Lanes scale = Lanes(1.0) / (tau + Lanes(half_length)), diagonal = tau * scale;
    const Lanes coupling = (Lanes(half_length) * scale) * (Lanes(half_length) * scale);
    static_assert(kDegree % 2 == 0);
    Lanes below = 1.0, here = 1.0;  // D_{j-2}, D_{j-1}
    inverse[0] = scale;
    for (int j = 1; j < kTerms; j += 2) {
      const Lanes next = mul_add(diagonal, here, coupling * Lanes(kOneOver.odd[j] * kOneOver.odd[j - 1]) * below);
      const Lanes last = mul_add(diagonal, next, coupling * Lanes(kOneOver.odd[j + 1] * kOneOver.odd[j]) * here);
      const Lanes both = scale / (next * last);  // of two quotients one division
      inverse[j] = (here * last) * both;
      inverse[j + 1] = (next * next) * both;
      below = next, here = last;
    }
    for (int j = 0; j < kTerms; ++j) upper[j] = Lanes(half_length * kOneOver.odd[j + 1]) * inverse[j];
    for (int j = 1; j < kTerms; ++j) lower[j] = Lanes(half_length * kOneOver.odd[j - 1]) * inverse[j - 1];
  }

  /// Forward elimination for the input e from v(start).
  template <int degree = kDegree>
  void eliminate(Series& g, const Series& e, Lanes start) const {
    Lanes below = g[0] = e[0] - start;
    for (int j = 1; j <= degree; ++j) g[j] = below = mul_sub_from(lower[j], below, e[j]);
  }

  /// Coefficient k of v' after elimination, from the one above, 0 above the last.
  Lanes substitute(const Series& g, int k, Lanes above) const {
    return mul_add(upper[k], above, g[k] * inverse[k]);
  }

  /// w = v' for the input e from v(start). w may be e.
  template <int degree = kDegree>
  void set_slope(Series& w, const Series& e, Lanes start) const {
    eliminate<degree>(w, e, start);
    Lanes above = 0.0;
    for (int k = degree; k >= 0; --k) w[k] = above = substitute(w, k, above);
  }
};

}  // namespace portrait::PORTRAIT_ISA_NAME
