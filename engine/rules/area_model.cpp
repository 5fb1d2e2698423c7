#include "engine/rules/area_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/loop/polynomial.h"

namespace portrait::rules {
namespace {

/// Areas of a plant with A_0 = 1 and A_1 = +-1, or A_2 = +-1 when A_1 is 0: polynomials of any plant in one scale.
struct Scaled {
  Areas A;
  double K, T;
};
Scaled scaled(const Areas& areas) {
  const double A0 = areas[0];
  const double by_first = std::abs(areas[1] / A0), by_second = std::sqrt(std::abs(areas[2] / A0));
  const double T = std::max(by_first, by_second);
  Scaled s{areas, A0, T > 0 ? T : 1};
  for (std::size_t i = 0; i < s.A.size(); ++i) s.A[i] /= A0 * std::pow(s.T, static_cast<double>(i));
  return s;
}
AreaModel in_real_units(const AreaModel& m, const Scaled& s) {
  return {.K = s.K, .b1 = m.b1 * s.T, .Td = m.Td * s.T, .a1 = m.a1 * s.T, .a2 = m.a2 * s.T * s.T};
}

/// Roots of first-order plants come in pairs that rounding parts by the square root of its size.
constexpr double kReal = 1e-5;

/// Real roots not below 0, increasing; what rounding put just beside counts as on.
std::vector<double> dead_times(const Polynomial& p) {
  std::vector<double> found;
  if (std::abs(p[0]) < 1e-12) found.push_back(0);
  for (const std::complex<double>& root : complex_roots(p))
    if (std::abs(root.imag()) <= kReal && root.real() >= -kReal) found.push_back(std::max(0.0, root.real()));
  std::sort(found.begin(), found.end());
  return found;
}

/// REQUIRES: A_0 = 1.
Polynomial cubic(const Areas& A) {
  return {-A[1] * A[1] * A[1] + 2 * A[1] * A[2] - A[3], A[1] * A[1] - A[2], -A[1] / 2, 1.0 / 6};
}
Polynomial sextic(const Areas& A) {
  const double A1 = A[1], A2 = A[2], A3 = A[3], A4 = A[4];
  return {144 * (A4 * A1 * A1 + A3 * A3 + A2 * A2 * A2 - A4 * A2 - 2 * A3 * A2 * A1),
          144 * (A3 * A1 * A1 - A2 * A2 * A1 - A4 * A1 + A3 * A2),
          72 * (A4 + A2 * A1 * A1 - 2 * A3 * A1),
          24 * (A3 - A1 * A1 * A1),
          6 * (-A2 + 3 * A1 * A1),
          -6 * A1,
          1};
}

/// a_1 and a_2 for a dead time and a zero.                                                          [Kos2021 (3.7)]
AreaModel with_lags(const Areas& A, double T, double b1) {
  const double a1 = A[1] + b1 - T;
  return {.K = 1, .b1 = b1, .Td = T, .a1 = a1, .a2 = -A[2] + T * T / 2 - b1 * T + A[1] * a1};
}

/// [Kos2021 (3.6)]
double zero_for(const Areas& A, double T) {
  const double A1 = A[1], A2 = A[2], A3 = A[3];
  const double above =
      T * T * T - 3 * A1 * T * T - 6 * A2 * T - 6 * A3 + 6 * A1 * A1 * T + 12 * A2 * A1 - 6 * A1 * A1 * A1;
  const double below = 3 * (T * T - 2 * A1 * T - 2 * A2 + 2 * A1 * A1);
  return std::abs(below) < 1e-9 && std::abs(above) < 1e-6 ? 0 : above / below;
}

bool has_real_lags_or_none(const AreaModel& m) { return m.a1 >= -kReal && m.a2 >= -kReal; }

/// What (3.12) asks of two models that both fit.
std::optional<AreaModel> chosen(const std::vector<AreaModel>& models, bool minimum_phase, double without_zero) {
  for (const AreaModel& m : models)
    if (has_real_lags_or_none(m) && (models.size() == 1 || (m.Td >= without_zero) == minimum_phase)) return m;
  for (const AreaModel& m : models)
    if (has_real_lags_or_none(m)) return m;
  return std::nullopt;
}

}  // namespace

std::optional<AreaModel> model_without_zero(const Areas& areas) {
  const Scaled s = scaled(areas);
  const std::vector<double> T = dead_times(cubic(s.A));
  if (T.empty()) return std::nullopt;
  return in_real_units(with_lags(s.A, T.front(), 0), s);
}

AreaModel model_with_dead_time(const Areas& areas, double dead_time) {
  const Scaled s = scaled(areas);
  const double T = dead_time / s.T;
  return in_real_units(with_lags(s.A, T, zero_for(s.A, T)), s);
}

std::optional<AreaModel> model_with_zero(const Areas& areas, bool minimum_phase) {
  const Scaled s = scaled(areas);
  const std::vector<double> simple = dead_times(cubic(s.A));
  const double without_zero = simple.empty() ? 0 : simple.front();
  std::vector<AreaModel> models;
  for (const double T : dead_times(sextic(s.A))) models.push_back(with_lags(s.A, T, zero_for(s.A, T)));
  if (const auto model = chosen(models, minimum_phase, without_zero)) return in_real_units(*model, s);
  const AreaModel plain = with_lags(s.A, without_zero, 0);
  if (!has_real_lags_or_none(plain)) return std::nullopt;
  return in_real_units(plain, s);
}

}  // namespace portrait::rules
