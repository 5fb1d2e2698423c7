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

/// Of an error: sum of |c_k|; of c_k^2/(2k+1), half the integral of the square; and what the moment of the square needs,
/// int x P_k P_{k-1} = 2k/((2k-1)(2k+1)) = (1 + 1/(2k-1))/(2k+1), k >= 2. Coefficients come from the highest down.
struct ErrorSums {
  Lanes rest = 0.0, squares = 0.0, moments = 0.0;

  void add(int k, Lanes c) {
    const Lanes scaled = c * Lanes(1.0 / (2 * k + 1));
    rest += abs(c);
    squares = mul_add(c, scaled, squares);
    moments = mul_add(above_, c + scaled, moments);
    above_ = scaled;
  }

 private:
  Lanes above_ = 0.0;  ///< c_{k+1}/(2k+3)
};

inline Lanes rest_of(const Series& f) {
  Rest rest;
  for (int k = kDegree; k >= 1; --k) rest.add(f[k]);
  return rest.sum;
}

inline ErrorSums error_sums_of(const Series& f) {
  ErrorSums sums;
  for (int k = kDegree; k >= 1; --k) sums.add(k, f[k]);
  return sums;
}

}  // namespace portrait::PORTRAIT_ISA_NAME
