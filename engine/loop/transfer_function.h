/// A rational function of s, its denominator in factors: G(s) = N(s)/(D_1(s) D_2(s) ...).
///
/// Factors keep their digits: (1 + Tf s)^n written out and solved again has lost all but one n-th of the digits of Tf.
/// A text like tf:1/1,4,6,4,1 has one factor beside its powers of s, and is taken as its coefficients are.
/// shape     polynomials from the lowest power up
/// unit      s per the unit of time in which the coefficients are given
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "engine/loop/polynomial.h"

namespace portrait {

struct TransferFunction {
  Polynomial numerator{1};
  std::vector<Polynomial> denominator;  ///< each of degree 1 or more
};

/// N(s)/D(s) from coefficients; powers of s are split off the denominator, as many integrators.
/// REQUIRES: the denominator is not 0.
TransferFunction transfer_function(Polynomial numerator, Polynomial denominator);

/// K/(T s + 1)^order
TransferFunction multiple_lag(double K, double T, int order);

/// D_1 D_2 ... written out.
Polynomial written_out(const std::vector<Polynomial>& factors);
int degree(const std::vector<Polynomial>& factors);

std::complex<double> value(const Polynomial& p, std::complex<double> s);
std::complex<double> value(const TransferFunction& G, std::complex<double> s);

/// Degree of the denominator less that of the numerator: below 0 is improper. 0 counts as strictly proper.
int relative_degree(const TransferFunction& G);

TransferFunction in_time_unit(TransferFunction G, double unit);

/// Why this cannot be computed with ("the highest coefficient of a denominator is 0"), or nothing.
std::optional<std::string> why_invalid(const TransferFunction& G);

/// c s^k times factors 1 + a s + b s^2: the roots of real polynomials, two by two.
struct Quadratic {
  double a = 0, b = 0;
};
struct Factored {
  double lowest = 1;  ///< c, the coefficient of the lowest power
  int power = 0;      ///< k
  std::vector<Quadratic> factors;
};
/// accuracy  factors of degree 1 and 2 are kept to the last bit; those of higher degrees are products of computed
///           roots, which together give back the coefficients to rounding. REQUIRES: no factor is 0.
Factored factored(const std::vector<Polynomial>& factors);

}  // namespace portrait
