/// The open loop as a function of frequency, kept in factors so that no digit is lost at either end of the axis.
///
///     L(s) = C(s) Q(s) P(s) = N(s) e^{-s} / D(s)
///     N(s) = n0 + n1 s + n2 s^2,      D(s) = s^k (T_1 s + 1)(T_2 s + 1)...
///
/// The closed loop's characteristic quasi-polynomial is D(s) + N(s) e^{-s}.               [Huba2022 (10), (20)]
/// unit      s and omega per dead time, T in dead times
#pragma once

#include <array>
#include <complex>
#include <vector>

#include "engine/loop/loop.h"
#include "engine/loop/polynomial.h"

namespace portrait {

struct OpenLoop {
  std::array<double, 3> numerator{};  ///< n0, n1, n2, none below 0
  int integrators = 0;                ///< k
  std::vector<double> lags;           ///< T_i, all above 0
};

/// REQUIRES: the loop is valid.
OpenLoop open_loop(const Loop& loop);

/// L(j omega), omega > 0.
std::complex<double> response_at(const OpenLoop& loop, double omega);
/// d/domega of L(j omega) divided by L(j omega).
std::complex<double> log_slope_at(const OpenLoop& loop, double omega);
/// |L(j omega)|.
double gain_at(const OpenLoop& loop, double omega);
/// arg L(j omega), continuous over omega > 0, tending to -k pi/2 as omega -> 0.
double phase_at(const OpenLoop& loop, double omega);

/// |N(j omega)|^2 and |D(j omega)|^2 as polynomials of x = omega^2.
Polynomial numerator_squared(const OpenLoop& loop);
Polynomial denominator_squared(const OpenLoop& loop);

/// Frequencies at which |L| crosses 1, increasing.
std::vector<double> gain_crossovers(const OpenLoop& loop);
/// Frequencies at which |L| has an extreme, increasing.
std::vector<double> gain_extremes(const OpenLoop& loop);

/// Frequencies at which arg L turns, increasing: from the last one on it falls for ever.
std::vector<double> phase_extremes(const OpenLoop& loop);

/// lim |L(j omega)| as omega -> infinity: 0 for a retarded loop; a neutral loop (ideal derivative on ipdt:
/// delta, on fotd: delta/tau_1) has a limit above 0, and is stable only below 1.
double high_frequency_gain(const OpenLoop& loop);
/// lim |L(j omega)| as omega -> 0; inf with an integrator.
double low_frequency_gain(const OpenLoop& loop);

}  // namespace portrait
