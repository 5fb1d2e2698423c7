#include "engine/reference/quiet.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace portrait::reference {
namespace {

constexpr double kTolerance = 1e-10;

double deviation(Series c, double at_rest) {
  c(0) -= at_rest;
  return bound(c);
}

double largest(const std::vector<double>& d, std::size_t from, std::size_t to) {
  return *std::max_element(d.begin() + static_cast<std::ptrdiff_t>(from),
                           d.begin() + static_cast<std::ptrdiff_t>(to));
}

/// Whether the tail of one signal, given its largest deviations per interval, is too small to matter.
bool tail_is_small(const std::vector<double>& d) {
  const std::size_t T = d.size(), quarter = T / 4;
  const double m1 = largest(d, T - 2 * quarter, T - quarter), m2 = largest(d, T - quarter, T);
  if (m2 == 0) return true;
  const double rho = m2 / m1;
  if (!(rho < 1)) return false;
  const double tail = static_cast<double>(quarter) * m2 * rho / (1 - rho);
  return tail <= kTolerance * std::accumulate(d.begin(), d.end(), 0.0);
}

}  // namespace

void QuietWatch::take_in_new_intervals() {
  for (std::size_t step = 0; step < kSteps; ++step) {
    const StepResponse& r = response_.steps[step];
    if (r.pieces.empty()) continue;
    auto& y = deviations_[2 * step];
    auto& u = deviations_[2 * step + 1];
    while ((y.size() + 1) * panels_ <= r.pieces.size()) {
      double y_largest = 0, u_largest = 0;
      for (std::size_t i = y.size() * panels_; i < (y.size() + 1) * panels_; ++i) {
        y_largest = std::max(y_largest, deviation(r.pieces[i].y, r.at_rest.y));
        u_largest = std::max(u_largest, deviation(r.pieces[i].u, r.at_rest.u));
      }
      y.push_back(y_largest);
      u.push_back(u_largest);
    }
  }
}

bool QuietWatch::is_quiet() {
  if (pieces_so_far() < next_look_ * panels_) return false;
  next_look_ += std::max<std::size_t>(8, next_look_ / 10);
  take_in_new_intervals();
  return std::all_of(deviations_.begin(), deviations_.end(),
                     [](const auto& of_signal) { return of_signal.empty() || tail_is_small(of_signal); });
}

std::size_t QuietWatch::pieces_so_far() const {
  std::size_t most = 0;
  for (const StepResponse& step : response_.steps) most = std::max(most, step.pieces.size());
  return most;
}

}  // namespace portrait::reference
