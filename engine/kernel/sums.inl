/// Sums over the coefficients of a series that the meters ask for. All leave the first coefficient out, which alone changes
/// when a constant is added.
#pragma once

#include "engine/kernel/legendre.inl"

namespace portrait::PORTRAIT_ISA_NAME {

/// How far a slope is from constant: sum of |c_k|, k >= 1.
struct Rest {
  Lanes sum = 0.0;
  void add(Lanes c) { sum += abs(c); }
};

/// At least the sum of |c_k|, k >= 1, of the integral of a series over a panel, from that of the series itself:
/// c_k = (h/2)(f_{k-1}/(2k-1) - f_{k+1}/(2k+3)).
inline Lanes rest_of_integral(double half_length, Lanes first, Lanes rest) {
  return Lanes(half_length) * mul_add(Lanes(2.0 / 3), rest, abs(first));
}

/// Of an error: sum of c_k^2/(2k+1), half the integral of the square; and what the moment of the square needs,
/// int x P_k P_{k-1} = 2k/((2k-1)(2k+1)) = (1 + 1/(2k-1))/(2k+1), k >= 2.
struct ErrorSums {
  Lanes squares, moments;
};

/// Takes the coefficients from the highest down. Above `kSquared` the squares are left out: of series that have died out
/// at `degree` they are below rounding.
template <int degree>
struct ErrorSumsTo {
  static constexpr int kSquared = degree == kDegree ? 8 : 5;
  ErrorSums sums{Lanes(0.0), Lanes(0.0)};

  void add(int k, Lanes c) {
    if (k > kSquared) return;
    const Lanes scaled = c * Lanes(1.0 / (2 * k + 1));
    sums.squares = mul_add(c, scaled, sums.squares);
    sums.moments = mul_add(above_, c + scaled, sums.moments);
    above_ = scaled;
  }

 private:
  Lanes above_ = 0.0;  ///< c_{k+1}/(2k+3)
};

inline ErrorSums error_sums_of(const Series& f) {
  ErrorSumsTo<kDegree> of_f;
  for (int k = kDegree; k >= 1; --k) of_f.add(k, f[k]);
  return of_f.sums;
}

}  // namespace portrait::PORTRAIT_ISA_NAME
