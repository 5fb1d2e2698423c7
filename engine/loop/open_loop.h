/// The open loop as a function of frequency, kept in factors so that no digit is lost at either end of the axis.
///
///     L(s) = c s^-k  prod_i (1 + a_i s + b_i s^2) / prod_j (1 + a_j s + b_j s^2)  e^{-Td s} = N(s) e^{-Td s} / D(s)
///
/// The closed loop's characteristic quasi-polynomial is D(s) + N(s) e^{-Td s}.            [Huba2022 (10), (20)]
/// unit      s and omega per unit of time: the dead time where there is one
/// domain    any real zeros and poles; those on the imaginary axis, 0 apart, count as lying just left of it
#pragma once

#include <complex>
#include <vector>

#include "engine/loop/loop.h"
#include "engine/loop/transfer_function.h"

namespace portrait {

struct OpenLoop {
  double gain = 0;      ///< c, never 0
  int integrators = 0;  ///< k; below 0 for zeros at s = 0
  std::vector<Quadratic> zeros, poles;
  double dead_time = 1;
};

/// Of C Q: over s with integral action, K_-1 + K_0 s + ...; else K_0 + K_1 s + ...
Polynomial controller_numerator(const Loop& loop);

/// REQUIRES: the loop is valid.
OpenLoop open_loop(const Loop& loop);

/// Written out. REQUIRES: neither is 0.
OpenLoop open_loop(const std::vector<Polynomial>& numerator, const std::vector<Polynomial>& denominator,
                   double dead_time);

/// Of one factor at omega = sqrt(x): |1 + a j omega - b x|^2 as a polynomial of x.
inline Polynomial squared(const Quadratic& f) {
  return f.b == 0 ? Polynomial{1, f.a * f.a} : Polynomial{1, f.a * f.a - 2 * f.b, f.b * f.b};
}

/// |L(j omega)|^2 straight from the setting, for code that looks at every setting of a sweep: nothing is allocated.
/// REQUIRES: the loop is valid; omega > 0.
double gain_squared_at(const Loop& loop, double omega);

/// L(j omega), omega > 0.
std::complex<double> response_at(const OpenLoop& loop, double omega);
/// d/domega of L(j omega) divided by L(j omega).
std::complex<double> log_slope_at(const OpenLoop& loop, double omega);
/// |L(j omega)|.
double gain_at(const OpenLoop& loop, double omega);
/// arg L(j omega), continuous over omega > 0, tending to -k pi/2 as omega -> 0, less pi where c is negative.
double phase_at(const OpenLoop& loop, double omega);
/// Where arg L tends to as omega -> infinity: -inf with a dead time.
double high_frequency_phase(const OpenLoop& loop);

/// |N(j omega)|^2 and |D(j omega)|^2 as polynomials of x = omega^2.
Polynomial numerator_squared(const OpenLoop& loop);
Polynomial denominator_squared(const OpenLoop& loop);

/// Frequencies at which |L| crosses 1, increasing.
std::vector<double> gain_crossovers(const OpenLoop& loop);
/// Frequencies at which |L| has an extreme, increasing.
std::vector<double> gain_extremes(const OpenLoop& loop);

/// Frequencies at which arg L turns, increasing: from the last one on it is monotonic.
std::vector<double> phase_extremes(const OpenLoop& loop);

/// lim |L(j omega)| as omega -> infinity: 0 for a retarded loop; a neutral loop (ideal derivative on ipdt:
/// delta, on fotd: delta/tau_1) has a limit above 0, and is stable only below 1.
double high_frequency_gain(const OpenLoop& loop);
/// lim |L(j omega)| as omega -> 0; inf with an integrator.
double low_frequency_gain(const OpenLoop& loop);

/// Poles in the open right half-plane.
int unstable_poles(const OpenLoop& loop);

}  // namespace portrait
