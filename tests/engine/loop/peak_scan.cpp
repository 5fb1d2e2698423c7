#include "tests/engine/loop/peak_scan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace portrait {
namespace {

using Complex = std::complex<double>;
using Function = std::function<double(double)>;

/// Beyond 30 every turn of e^{-s} brings a peak, the highest ones where |L| is largest: how far these reach.
double highest_of_interest(const Loop& loop) {
  double largest = 0, highest = 60;
  for (double omega = 30; omega < 1e6; omega *= 1.05) {
    const double gain = std::abs(open_loop_as_written(loop, omega));
    if (gain > 0.9 * largest) highest = std::max(highest, omega);
    largest = std::max(largest, gain);
  }
  return std::min(highest, 2000.0);
}

/// Steps of 0.03 where the dead time turns L, 0.4 % where N may pass close by 0, 5 % towards rest.
std::vector<double> frequencies(double highest) {
  std::vector<double> all;
  for (double omega = 1e-11; omega < 1e-3; omega *= 1.05) all.push_back(omega);
  for (double omega = 1e-3; omega < highest; omega = std::min(1.004 * omega, omega + 0.03)) all.push_back(omega);
  return all;
}

/// Largest value between a and b, where f has one peak.
double golden_section(const Function& f, double a, double b) {
  const double part = 1 / std::numbers::phi;
  double left = b - part * (b - a), right = a + part * (b - a);
  double at_left = f(left), at_right = f(right), best = std::max(at_left, at_right);
  for (int i = 0; i < 60; ++i) {
    if (at_left > at_right) {
      b = right, right = left, at_right = at_left;
      at_left = f(left = b - part * (b - a));
    } else {
      a = left, left = right, at_left = at_right;
      at_right = f(right = a + part * (b - a));
    }
    best = std::max({best, at_left, at_right});
  }
  return best;
}

double peak(const std::vector<double>& omegas, const Function& f) {
  std::vector<double> values(omegas.size());
  std::transform(omegas.begin(), omegas.end(), values.begin(), f);
  const double highest = *std::max_element(values.begin(), values.end());
  double best = highest;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    if (values[i] >= values[i - 1] && values[i] >= values[i + 1] && values[i] > 0.8 * highest)
      best = std::max(best, golden_section(f, omegas[i - 1], omegas[i + 1]));
  return best;
}

}  // namespace

Complex open_loop_as_written(const Loop& loop, double omega) {
  const Setting& s = loop.setting;
  const Complex jw(0, omega);
  const Complex C = s.kappa * (1.0 + 1.0 / (s.tau_i * jw) + tau_d(s) * jw);
  Complex P = std::exp(-jw);
  if (loop.family.plant == Plant::dipdt) P /= jw * jw;
  if (loop.family.plant == Plant::ipdt) P /= jw;
  if (loop.family.plant == Plant::fotd) P /= s.tau_1 * jw + 1.0;
  for (int i = 0; i < loop.family.n; ++i) P /= s.tau_f * jw + 1.0;
  return C * P;
}

Peaks peaks_by_scan(const Loop& loop) {
  const std::vector<double> omegas = frequencies(highest_of_interest(loop));
  const auto S = [&](double omega) { return 1 / std::abs(1.0 + open_loop_as_written(loop, omega)); };
  const auto T = [&](double omega) {
    const Complex L = open_loop_as_written(loop, omega);
    return std::abs(L) / std::abs(1.0 + L);
  };
  const double in_the_limit = std::abs(open_loop_as_written(loop, 1e9));
  return {std::max(peak(omegas, S), 1 / (1 - in_the_limit)),
          std::max(peak(omegas, T), in_the_limit / (1 - in_the_limit))};
}

}  // namespace portrait
