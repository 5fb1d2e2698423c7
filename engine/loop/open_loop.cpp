#include "engine/loop/open_loop.h"

#include <cmath>
#include <map>
#include <numbers>

namespace portrait {
namespace {

using namespace std::complex_literals;

std::complex<double> numerator_at(const OpenLoop& loop, double omega) {
  const auto& [n0, n1, n2] = loop.numerator;
  return {n0 - n2 * omega * omega, n1 * omega};
}

/// Degree of N less that of D.
int excess(const OpenLoop& loop) {
  const int degree = loop.numerator[2] != 0 ? 2 : loop.numerator[1] != 0 ? 1 : 0;
  return degree - loop.integrators - static_cast<int>(loop.lags.size());
}

std::vector<double> roots_of_x(const Polynomial& of_x) {
  std::vector<double> roots = positive_sign_changes(of_x);
  for (double& root : roots) root = std::sqrt(root);
  return roots;
}

}  // namespace

OpenLoop open_loop(const Loop& loop) {
  const Setting& s = loop.setting;
  const bool integral = has_integral_action(s);
  OpenLoop open;
  open.numerator = integral ? std::array{s.kappa / s.tau_i, s.kappa, s.delta} : std::array{s.kappa, s.delta, 0.0};
  open.integrators = integrators(loop.family.plant) + (integral ? 1 : 0);
  if (loop.family.plant == Plant::fotd) open.lags.push_back(s.tau_1);
  open.lags.insert(open.lags.end(), static_cast<std::size_t>(loop.family.n), s.tau_f);
  return open;
}

std::complex<double> response_at(const OpenLoop& loop, double omega) {
  std::complex<double> value = numerator_at(loop, omega) * std::polar(1.0, -omega);
  for (int i = 0; i < loop.integrators; ++i) value /= 1i * omega;
  for (const double T : loop.lags) value /= 1.0 + 1i * T * omega;
  return value;
}

std::complex<double> log_slope_at(const OpenLoop& loop, double omega) {
  const auto& [n0, n1, n2] = loop.numerator;
  std::complex<double> slope = std::complex<double>(-2 * n2 * omega, n1) / numerator_at(loop, omega) - 1i;
  slope -= static_cast<double>(loop.integrators) / omega;
  for (const double T : loop.lags) slope -= 1i * T / (1.0 + 1i * T * omega);
  return slope;
}

double gain_at(const OpenLoop& loop, double omega) {
  double gain = std::abs(numerator_at(loop, omega)) / std::pow(omega, loop.integrators);
  for (const double T : loop.lags) gain /= std::hypot(1, T * omega);
  return gain;
}

double phase_at(const OpenLoop& loop, double omega) {
  // N's imaginary part stays above 0, so its principal angle is the continuous one.
  double phase = std::arg(numerator_at(loop, omega)) - omega - loop.integrators * std::numbers::pi / 2;
  for (const double T : loop.lags) phase -= std::atan(T * omega);
  return phase;
}

Polynomial numerator_squared(const OpenLoop& loop) {
  const auto& [n0, n1, n2] = loop.numerator;
  return {n0 * n0, n1 * n1 - 2 * n0 * n2, n2 * n2};
}

Polynomial denominator_squared(const OpenLoop& loop) {
  Polynomial d(static_cast<std::size_t>(loop.integrators) + 1, 0.0);
  d.back() = 1;
  for (const double T : loop.lags) d = product(d, {1, T * T});
  return d;
}

std::vector<double> gain_crossovers(const OpenLoop& loop) {
  return roots_of_x(difference(numerator_squared(loop), denominator_squared(loop)));
}

std::vector<double> gain_extremes(const OpenLoop& loop) {
  const Polynomial n = numerator_squared(loop), d = denominator_squared(loop);
  return roots_of_x(difference(product(derivative(n), d), product(n, derivative(d))));
}

/// arg L has the slope n1 (n0 + n2 x)/|N|^2 - 1 - sum_i T_i/(1 + T_i^2 x), x = omega^2; equal lags share a
/// denominator.
std::vector<double> phase_extremes(const OpenLoop& loop) {
  const auto& [n0, n1, n2] = loop.numerator;
  const Polynomial n = numerator_squared(loop);
  std::map<double, int> lags;
  for (const double T : loop.lags) ++lags[T];
  const auto denominators_but = [&](double left_out) {
    Polynomial d{1};
    for (const auto& [T, count] : lags)
      if (T != left_out) d = product(d, {1, T * T});
    return d;
  };
  Polynomial slope = product(difference({n1 * n0, n1 * n2}, n), denominators_but(kNaN));
  for (const auto& [T, count] : lags)
    slope = difference(slope, product(product(n, {count * T}), denominators_but(T)));
  return roots_of_x(slope);
}

double high_frequency_gain(const OpenLoop& loop) {
  if (excess(loop) < 0) return 0;
  if (excess(loop) > 0) return kInf;
  double gain = loop.numerator[2] != 0   ? loop.numerator[2]
                : loop.numerator[1] != 0 ? loop.numerator[1]
                                         : loop.numerator[0];
  for (const double T : loop.lags) gain /= T;
  return gain;
}

double low_frequency_gain(const OpenLoop& loop) { return loop.integrators > 0 ? kInf : loop.numerator[0]; }

}  // namespace portrait
