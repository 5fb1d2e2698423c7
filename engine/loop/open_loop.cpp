#include "engine/loop/open_loop.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace portrait {
namespace {

using namespace std::complex_literals;
using std::numbers::pi;

/// 1 + a j omega - b omega^2
std::complex<double> value(const Quadratic& f, double omega) { return {1 - f.b * omega * omega, f.a * omega}; }

/// d/domega of it, divided by it
std::complex<double> log_slope(const Quadratic& f, double omega) {
  return std::complex<double>(-2 * f.b * omega, f.a) / value(f, omega);
}

/// Its imaginary part keeps its sign, so the principal angle is the continuous one; a = 0 counts as 0+.
double angle(const Quadratic& f, double omega) { return std::arg(value(f, omega)); }

int degree(const std::vector<Quadratic>& factors) {
  int sum = 0;
  for (const Quadratic& f : factors) sum += f.b != 0 ? 2 : 1;
  return sum;
}

/// Degree of N less that of D.
int excess(const OpenLoop& loop) { return degree(loop.zeros) - degree(loop.poles) - loop.integrators; }

double leading(const Quadratic& f) { return std::abs(f.b != 0 ? f.b : f.a); }

/// How far the angle of a factor turns from omega = 0 to infinity.
double turn(const Quadratic& f) { return std::copysign(f.b > 0 ? pi : f.b == 0 ? pi / 2 : 0, f.a); }

Polynomial shifted(Polynomial p, int powers) {
  p.insert(p.begin(), static_cast<std::size_t>(powers), 0.0);
  return p;
}

std::vector<double> roots_of_x(const Polynomial& of_x) {
  std::vector<double> roots = positive_sign_changes(of_x);
  for (double& root : roots) root = std::sqrt(root);
  return roots;
}

int integrators_of(const Loop& loop) {
  return integrators(loop.family.plant) + (has_integral_action(loop.setting) ? 1 : 0);
}

/// `gain_squared_at` of a loop of any order.
double gain_squared_by_gains(const Loop& loop, double omega) {
  const auto K = gains_of(loop);
  const double x = omega * omega, tau_f = loop.setting.tau_f;
  double even = 0, odd = 0;  // of sum K_k s^(k+1): real part, and imaginary part over omega
  for (std::size_t i = K.size(); i-- > 0;) {
    double& part = i % 2 == 0 ? even : odd;
    part = K[i] - x * part;
  }
  double gain = (even * even + odd * odd * x) / x;
  for (int i = 0; i < integrators(loop.family.plant); ++i) gain /= x;
  const PlantLags lags = plant_lags(loop);
  for (int i = 0; i < lags.count; ++i) gain /= 1 + lags.time * lags.time * x;
  for (int i = 0; i < loop.family.n; ++i) gain /= 1 + tau_f * tau_f * x;
  return gain;
}

/// Written out, a polynomial of high degree has lost some digits: Newton's method on log |L| brings them back.
double polished(const OpenLoop& loop, double omega) {
  double best = omega, off = std::log(gain_at(loop, omega));
  for (int i = 0; i < 4 && off != 0; ++i) {
    const double next = best - off / log_slope_at(loop, best).real();
    if (!(std::abs(next - best) < 1e-3 * best)) break;
    const double next_off = std::log(gain_at(loop, next));
    if (!(std::abs(next_off) < std::abs(off))) break;
    best = next, off = next_off;
  }
  return best;
}

}  // namespace

Polynomial controller_numerator(const Loop& loop) {
  const auto K = gains_of(loop);
  const int last = has_gains(loop.family) ? loop.family.m : 1;
  return {K.begin() + (has_integral_action(loop.setting) ? 0 : 1), K.begin() + last + 2};
}

OpenLoop open_loop(const Loop& loop) {
  std::vector<Polynomial> D(static_cast<std::size_t>(integrators_of(loop)), {0, 1});
  const PlantLags lags = plant_lags(loop);
  D.insert(D.end(), static_cast<std::size_t>(lags.count), Polynomial{1, lags.time});
  D.insert(D.end(), static_cast<std::size_t>(loop.family.n), Polynomial{1, loop.setting.tau_f});
  return open_loop({controller_numerator(loop)}, D, 1);
}

double gain_squared_at(const Loop& loop, double omega) {
  if (!is_basic(loop.family)) return gain_squared_by_gains(loop, omega);
  const Setting& s = loop.setting;
  const bool integral = has_integral_action(s);
  const double n0 = integral ? s.kappa / s.tau_i : s.kappa, n1 = integral ? s.kappa : s.delta;
  const double n2 = integral ? s.delta : 0, x = omega * omega, real = n0 - n2 * x;
  double denominator = loop.family.plant == Plant::fotd ? 1 + s.tau_1 * s.tau_1 * x : 1;
  for (int i = 0; i < integrators_of(loop); ++i) denominator *= x;
  for (int i = 0; i < loop.family.n; ++i) denominator *= 1 + s.tau_f * s.tau_f * x;
  return (real * real + n1 * n1 * x) / denominator;
}

OpenLoop open_loop(const std::vector<Polynomial>& numerator, const std::vector<Polynomial>& denominator,
                   double dead_time) {
  Factored N = factored(numerator), D = factored(denominator);
  return {.gain = N.lowest / D.lowest,
          .integrators = D.power - N.power,
          .zeros = std::move(N.factors),
          .poles = std::move(D.factors),
          .dead_time = dead_time};
}

std::complex<double> response_at(const OpenLoop& loop, double omega) {
  std::complex<double> L = loop.gain * std::polar(1.0, -loop.dead_time * omega);
  for (int i = 0; i < loop.integrators; ++i) L /= 1i * omega;
  for (int i = 0; i < -loop.integrators; ++i) L *= 1i * omega;
  for (const Quadratic& f : loop.zeros) L *= value(f, omega);
  for (const Quadratic& f : loop.poles) L /= value(f, omega);
  return L;
}

std::complex<double> log_slope_at(const OpenLoop& loop, double omega) {
  std::complex<double> slope(-loop.integrators / omega, -loop.dead_time);
  for (const Quadratic& f : loop.zeros) slope += log_slope(f, omega);
  for (const Quadratic& f : loop.poles) slope -= log_slope(f, omega);
  return slope;
}

double gain_at(const OpenLoop& loop, double omega) {
  double gain = std::abs(loop.gain) / std::pow(omega, loop.integrators);
  for (const Quadratic& f : loop.zeros) gain *= std::abs(value(f, omega));
  for (const Quadratic& f : loop.poles) gain /= std::abs(value(f, omega));
  return gain;
}

double phase_at(const OpenLoop& loop, double omega) {
  double phase = -loop.dead_time * omega - loop.integrators * pi / 2 - (loop.gain < 0 ? pi : 0);
  for (const Quadratic& f : loop.zeros) phase += angle(f, omega);
  for (const Quadratic& f : loop.poles) phase -= angle(f, omega);
  return phase;
}

double high_frequency_phase(const OpenLoop& loop) {
  if (loop.dead_time > 0) return -kInf;
  double phase = -loop.integrators * pi / 2 - (loop.gain < 0 ? pi : 0);
  for (const Quadratic& f : loop.zeros) phase += turn(f);
  for (const Quadratic& f : loop.poles) phase -= turn(f);
  return phase;
}

Polynomial numerator_squared(const OpenLoop& loop) {
  Polynomial n{loop.gain * loop.gain};
  for (const Quadratic& f : loop.zeros) n = product(n, squared(f));
  return shifted(n, std::max(0, -loop.integrators));
}

Polynomial denominator_squared(const OpenLoop& loop) {
  Polynomial d{1};
  for (const Quadratic& f : loop.poles) d = product(d, squared(f));
  return shifted(d, std::max(0, loop.integrators));
}

std::vector<double> gain_crossovers(const OpenLoop& loop) {
  std::vector<double> found = roots_of_x(difference(numerator_squared(loop), denominator_squared(loop)));
  for (double& omega : found) omega = polished(loop, omega);
  return found;
}

std::vector<double> gain_extremes(const OpenLoop& loop) {
  const Polynomial n = numerator_squared(loop), d = denominator_squared(loop);
  return roots_of_x(difference(product(derivative(n), d), product(n, derivative(d))));
}

/// arg L has the slope sum_i +-a_i (1 + b_i x)/|1 + a_i s + b_i s^2|^2 - Td, x = omega^2; equal factors share a
/// denominator, and a zero that is a pole cancels.
std::vector<double> phase_extremes(const OpenLoop& loop) {
  std::map<std::pair<double, double>, int> factors;
  for (const Quadratic& f : loop.zeros) ++factors[{f.a, f.b}];
  for (const Quadratic& f : loop.poles) --factors[{f.a, f.b}];
  std::erase_if(factors, [](const auto& entry) { return entry.second == 0; });
  Polynomial all{loop.dead_time};
  for (const auto& [at, count] : factors) all = product(all, squared({at.first, at.second}));
  Polynomial slope = scaled(-1, all);
  for (const auto& [at, count] : factors) {
    Polynomial term{-count * at.first, -count * at.first * at.second};
    for (const auto& [other, other_count] : factors)
      if (other != at) term = product(term, squared({other.first, other.second}));
    slope = difference(slope, term);
  }
  return roots_of_x(slope);
}

double high_frequency_gain(const OpenLoop& loop) {
  if (excess(loop) < 0) return 0;
  if (excess(loop) > 0) return kInf;
  double gain = std::abs(loop.gain);
  for (const Quadratic& f : loop.zeros) gain *= leading(f);
  for (const Quadratic& f : loop.poles) gain /= leading(f);
  return gain;
}

double low_frequency_gain(const OpenLoop& loop) {
  return loop.integrators > 0 ? kInf : loop.integrators < 0 ? 0 : std::abs(loop.gain);
}

int unstable_poles(const OpenLoop& loop) {
  int count = 0;
  for (const Quadratic& f : loop.poles)
    if (f.a < 0) count += f.b != 0 ? 2 : 1;
  return count;
}

}  // namespace portrait
