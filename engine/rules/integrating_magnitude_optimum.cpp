#include "engine/rules/integrating_magnitude_optimum.h"

#include <cmath>

#include "engine/base/check.h"
#include "engine/loop/polynomial.h"

namespace portrait::rules {
namespace {

double squared(double x) { return x * x; }

/// Ki of the first condition.                                                                       [Kos2021 (4.4)]
double pi_integral_gain(const Areas& A, double b, double Kp) { return 0.5 * A[0] * (1 - b * b) * Kp * Kp; }

/// G_i0 of (5.8).
struct Ratios {
  double G00, G10, G20, G30, G40;
};
Ratios ratios(const Areas& A) {
  return {1 / A[0], -A[1] / A[0], A[2] / A[0], A.size() > 3 ? -A[3] / A[0] : 0, A.size() > 4 ? A[4] / A[0] : 0};
}

/// Coefficients of (5.11), lowest first.                                                           [Kos2021 (5.12)]
Polynomial quartic(const Ratios& r, double b) {
  const double g1 = r.G10, g2 = r.G20, g3 = r.G30, g4 = r.G40, q1 = g1 * g1, q2 = g2 * g2;
  const double alpha = (1 - b) * squared(1 + b) * (q1 * (1 - b) + 2 * b * g2);
  const double beta = 8 * ((1 - b * b) * q1 * g1 + (2 * b * b + b - 1) * g1 * g2 - b * (1 + b) * g3);
  const double gamma = 8 * (-(b * b - 3) * q1 * q1 + (3 * b * b + b - 6) * q1 * g2 - 2 * (b * b + b - 1) * g1 * g3 +
                            (1 - b * b) * q2 + b * (1 + b) * g4);
  const double delta = 16 * (2 * q1 * q1 * g1 - 6 * q1 * g1 * g2 + 3 * (q1 * g3 + g1 * q2) - g1 * g4 - g2 * g3);
  const double epsilon = 16 * (q1 * q1 * q1 - 4 * q1 * q1 * g2 + 2 * q1 * g1 * g3 + 4 * q1 * q2 - q1 * g4 -
                               2 * g1 * g2 * g3 - q2 * g2 + g2 * g4);
  return {epsilon, delta, gamma, beta, alpha};
}

/// (5.10) and (5.13).
ParallelForm pid_of_integral_time(const Ratios& r, double b, double Ti) {
  const double bracket = -2 * r.G10 * r.G10 - 2 * r.G10 * Ti + 2 * r.G20 + b * Ti * Ti * (1 + b);
  const double Ki = -r.G00 * squared(b - 1) * bracket / (0.25 * std::pow(b * b - 1, 3) * std::pow(Ti, 4));
  return {.Kp = Ki * Ti, .Ki = Ki, .Kd = (0.5 * (1 - b * b) * Ti * Ti * Ki - r.G00) / (1 - b)};
}

}  // namespace

std::optional<ParallelForm> integrating_pi(const Areas& A, double b) {
  PORTRAIT_CHECK(A.size() >= 3 && A[1] != 0 && b >= 0 && b <= 1);
  const double under_root = A[1] * A[1] + (1 - b * b) * (A[0] * A[2] - A[1] * A[1]);
  if (under_root < 0) return std::nullopt;
  const double Kp = 1 / (A[1] + std::copysign(std::sqrt(under_root), A[1]));
  return ParallelForm{.Kp = Kp, .Ki = pi_integral_gain(A, b, Kp), .Kd = 0};
}

double residence_time(const Areas& A, const ParallelForm& form, double b) {
  return b < 1 ? (1 - b) * form.Kp / form.Ki : 1 / (A[0] * form.Kp);
}

ParallelForm integrating_pi_of_speed(const Areas& A, double b, double T) {
  const double Kp = b < 1 ? 2 / (T * A[0] * (1 + b)) : 1 / (A[0] * T);
  return {.Kp = Kp, .Ki = b < 1 ? pi_integral_gain(A, b, Kp) : 0, .Kd = 0};
}

std::optional<ParallelForm> integrating_pid(const Areas& A, double b) {
  PORTRAIT_CHECK(A.size() >= 5 && b >= 0 && b < 1);
  // In units of A_1/A_0, so that roots of any size are found alike.
  const double T = std::abs(A[1] / A[0]);
  Areas scaled = A;
  for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] /= std::pow(T, static_cast<double>(i));
  const Ratios r = ratios(scaled);
  const std::vector<double> roots = positive_sign_changes(quartic(r, b));
  if (roots.empty()) return std::nullopt;
  const ParallelForm form = pid_of_integral_time(r, b, roots.back());
  return ParallelForm{.Kp = form.Kp / T, .Ki = form.Ki / (T * T), .Kd = form.Kd};
}

std::optional<ParallelForm> integrating_pd(const Areas& A) {
  PORTRAIT_CHECK(A.size() >= 4);
  const double determinant = 2 * (A[1] * A[2] - A[0] * A[3]);
  if (std::abs(determinant) <= 1e-12 * std::abs(A[1] * A[2])) return std::nullopt;
  return ParallelForm{.Kp = A[2] / determinant, .Ki = 0, .Kd = A[3] / determinant};
}

double slowest_pid(const Areas& A, double b) {
  if (b == 1) return 2 * A[1] / A[0];
  const double root = std::sqrt(A[1] * A[1] * b * b + A[0] * A[2] * (1 - b * b));
  return (A[1] + std::copysign(root, A[1])) / (0.5 * A[0] * (1 + b));
}

std::optional<ParallelForm> integrating_pid_of_speed(const Areas& A, double b, double T) {
  if (!(T < slowest_pid(A, b))) return integrating_pi_of_speed(A, b, T);
  if (b < 1) return pid_of_integral_time(ratios(A), b, T / (1 - b));
  const double Kp = 1 / (A[0] * T);
  return ParallelForm{.Kp = Kp, .Ki = 0, .Kd = (A[1] * Kp - 0.5) / A[0]};
}

std::array<double, 2> reference_filter_2(const Areas& A, const ParallelForm& pid, const ParallelForm& pd) {
  const double A0 = A[0], K1 = pd.Kp;
  return {pid.Kp / pid.Ki - 1 / (A0 * K1), (A0 * A0 * pid.Kd * K1 * K1 + A0 * K1 * K1 - A0 * pid.Kp * K1 +
                                            A0 * pid.Ki * pd.Kd - A[1] * pid.Ki * K1 + pid.Ki) /
                                               (A0 * A0 * pid.Ki * K1 * K1)};
}

std::array<double, 5> reference_filter_5(const AreaModel& model, const ParallelForm& pid, double Tf) {
  const auto [K, b1, T, a1, a2] = model;
  // The lower coefficients of the closed loop's denominator, Pade (2,2) in place of the dead time.  [Kos2021 (5.42)]
  const Polynomial plant = product(product({1, a1, a2}, {1, Tf}), {1, T / 2, T * T / 12});
  const Polynomial open = product(product({1, pid.Kp / pid.Ki, pid.Kd / pid.Ki}, {1, b1}), {1, -T / 2, T * T / 12});
  std::array<double, 5> b{};
  for (std::size_t i = 1; i <= 5; ++i)
    b[i - 1] = (i < open.size() ? open[i] : 0) + (i >= 2 ? plant[i - 2] / (K * pid.Ki) : 0);
  return b;
}

}  // namespace portrait::rules
