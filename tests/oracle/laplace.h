/// A signal from its Laplace transform, by Talbot's contour: f(t) = 1/(2 pi j) int F(s) e^{st} ds.
///
/// The contour s(a) = (N/t) (0.5017 a cot(0.6407 a) - 0.6122 + 0.2645 j a), -pi < a < pi, wraps the left half-plane, so F must have
/// its singularities near the negative real axis: a loop with dead time is first written as its finite sum of delayed
/// rational functions, 1/(1 + L) = 1 - L + L^2 - ..., of which those with e^{-ks}, k <= t, matter at time t. Each has
/// the poles of L, all of them known, and is inverted by itself, its dead time being a shift.
///
/// The weights grow like e^{0.4 N}: in long double N = 46 leaves about 1e-12.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

namespace portrait::oracle {

using Real = long double;
using Complex = std::complex<Real>;

/// f(t), t > 0, of a transform whose singularities all have |Im s| < N/(6 t) or so.
template <typename Transform>
Real inverse_laplace(const Transform& F, Real t, int N = 40) {
  constexpr Real pi = std::numbers::pi_v<Real>;
  Complex sum = 0;
  for (int k = 0; k < N; ++k) {
    const Real a = (2 * k + 1) * pi / N - pi, angle = Real{0.6407L} * a, cot = std::cos(angle) / std::sin(angle);
    const Complex z = Real(N) * Complex(Real{0.5017L} * a * cot - Real{0.6122L}, Real{0.2645L} * a);
    const Real slope = Real{0.5017L} * (cot - angle / (std::sin(angle) * std::sin(angle)));
    const Complex dz = Real(N) * Complex(slope, Real{0.2645L});
    sum += std::exp(z) * F(z / t) * dz;
  }
  // ds = dz/t da, and 1/(2 pi j) times the step 2 pi/N.
  return (sum / Complex(0, N * t)).real();
}

/// The same, and how far two contours differ: poles far from the real axis lie outside of either.
struct Inverted {
  Real value, uncertain;
};
template <typename Transform>
Inverted inverted(const Transform& F, Real t) {
  const Real value = inverse_laplace(F, t, 46);
  return {value, std::abs(value - inverse_laplace(F, t, 40))};
}

}  // namespace portrait::oracle
