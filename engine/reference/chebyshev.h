/// A smooth signal on one panel of time as a Chebyshev series, and what can be asked of it exactly.
///
///     f(x) = sum_k c_k T_k(x),   -1 <= x <= 1
///
/// Since |T_k| <= 1, a series whose |c_0| exceeds the sum of all other |c_k| has no zero: the searches below
/// cut the panel in halves until that test, or the same test on the derivative, decides. Nothing is sampled.
/// shape     c_0 .. c_N
/// accuracy  rounding: tests/engine/reference/chebyshev_test.cpp
#pragma once

#include <vector>

#include <Eigen/Core>

namespace portrait::reference {

using Series = Eigen::VectorXd;

/// Clenshaw's sum.
double value(const Series& c, double x);

/// d/dx, one coefficient shorter.
Series derivative(const Series& c);

/// The antiderivative that is 0 at x = -1, one coefficient longer.
Series antiderivative(const Series& c);

/// f(x) g(x). REQUIRES: neither is empty.
Series product(const Series& f, const Series& g);

/// The same function on [from, to] within [-1, 1], as a series of its own.
Series restricted(const Series& c, double from, double to);

/// The points of [-1, 1] at which f changes sign, increasing. A function no larger than `noise` has none; a
/// root of even order is no change of sign, one of odd order is; of several within 2e-6 of each other some may
/// be missing, but the sign after them is right. A root at an end, to rounding, may be found or not.
std::vector<double> sign_changes(const Series& c, double noise);

/// Sum of |c_k|: |f| is nowhere larger.
double bound(const Series& c);

}  // namespace portrait::reference
