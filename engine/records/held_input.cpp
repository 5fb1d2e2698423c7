#include "engine/records/held_input.h"

#include <algorithm>
#include <cmath>

namespace portrait::records {

HeldInput::HeldInput(const Record& r) : t_(r.t), once_(r.size()), twice_(r.size()) {
  for (const double u : r.u) u_.push_back(u - r.u[0]);
  for (std::size_t i = 1; i < r.size(); ++i) {
    const double h = t_[i] - t_[i - 1];
    once_[i] = once_[i - 1] + h * u_[i - 1];
    twice_[i] = twice_[i - 1] + h * once_[i - 1] + h * h / 2 * u_[i - 1];
  }
}

std::size_t HeldInput::interval(double t) const {
  const auto after = std::upper_bound(t_.begin(), t_.end(), t);
  return after == t_.begin() ? 0 : static_cast<std::size_t>(after - t_.begin()) - 1;
}

double HeldInput::integral(double t) const {
  if (t <= t_[0]) return 0;
  const std::size_t i = interval(t);
  return once_[i] + (t - t_[i]) * u_[i];
}

double HeldInput::double_integral(double t) const {
  if (t <= t_[0]) return 0;
  const std::size_t i = interval(t);
  const double h = t - t_[i];
  return twice_[i] + h * once_[i] + h * h / 2 * u_[i];
}

std::vector<double> HeldInput::lagged(const std::vector<double>& times, double Td, double T) const {
  std::vector<double> answer;
  std::size_t i = 0;
  double x = 0;  // at t_[i]
  const auto advanced = [&](double from, std::size_t k, double h) {
    return u_[k] + (from - u_[k]) * std::exp(-h / T);
  };
  for (const double time : times) {
    const double t = time - Td;
    while (i + 1 < t_.size() && t_[i + 1] <= t) x = advanced(x, i, t_[i + 1] - t_[i]), ++i;
    answer.push_back(t <= t_[0] ? 0 : advanced(x, i, t - t_[i]));
  }
  return answer;
}

}  // namespace portrait::records
