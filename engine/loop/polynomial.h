/// Real polynomials of one variable: small, dense, coefficients from the lowest power up.
#pragma once

#include <complex>
#include <vector>

namespace portrait {

using Polynomial = std::vector<double>;  ///< p(x) = p[0] + p[1] x + ...

double value(const Polynomial& p, double x);
Polynomial derivative(const Polynomial& p);
Polynomial product(const Polynomial& p, const Polynomial& q);
Polynomial difference(const Polynomial& p, const Polynomial& q);
Polynomial scaled(double factor, Polynomial p);
/// p without the zeros above its highest power; empty for 0.
Polynomial trimmed(Polynomial p);
/// Of p as it stands: -1 for 0.
int degree(const Polynomial& p);
/// p(s/unit), with s measured per another unit of time.
Polynomial in_time_unit(Polynomial p, double unit);

/// p = quotient * d + rest, the rest of lower degree than d.
struct Division {
  Polynomial quotient, rest;
};
/// REQUIRES: d is trimmed and not 0.
Division divided(const Polynomial& p, const Polynomial& d);

/// The points x > 0 at which p changes sign, increasing.
/// method    between two neighbouring stationary points p is monotonic: the roots of p' separate those of p
/// accuracy  a few units in the last place, as far as p can be evaluated: tests/engine/loop/polynomial_test.cpp;
///           a root of even order is no sign change and is left out
std::vector<double> positive_sign_changes(const Polynomial& p);

/// All roots but those at 0, in no order, as eigenvalues of the companion matrix.
/// accuracy  that of the eigenvalues: a root of multiplicity m has only one m-th of the digits
std::vector<std::complex<double>> complex_roots(const Polynomial& p);

}  // namespace portrait
