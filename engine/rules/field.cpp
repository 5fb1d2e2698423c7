#include "engine/rules/field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace portrait::rules {
namespace {
constexpr double kPi = std::numbers::pi;
}

StandardForm simc_pi(const LagDelayPlant& p, double Tc) {
  return {.Kc = p.T / (p.K * (Tc + p.tau)), .Ti = std::min(p.T, 4 * (Tc + p.tau)), .TD = 0};
}

StandardForm simc_pi(const IntegratingPlant& p, double Tc) {
  return {.Kc = 1 / (p.k * (Tc + p.tau)), .Ti = 4 * (Tc + p.tau), .TD = 0};
}

SeriesForm simc_pid(const LagDelayPlant& p, double T2, double Tc) {
  const StandardForm pi = simc_pi(p, Tc);
  return {.Kc = pi.Kc, .Ti = pi.Ti, .TD = T2};
}

SeriesForm simc_double_integrator(double k, double tau, double Tc) {
  const double sum = Tc + tau;
  return {.Kc = 1 / (4 * k * sum * sum), .Ti = 4 * sum, .TD = 4 * sum};
}

SeriesForm isimc_pid(const LagDelayPlant& p, double Tc) { return simc_pid(p, p.tau / 3, Tc); }

SeriesForm isimc_pid(const IntegratingPlant& p, double Tc) {
  const StandardForm pi = simc_pi(p, Tc);
  return {.Kc = pi.Kc, .Ti = pi.Ti, .TD = p.tau / 3};
}

StandardForm isimc_pi(const LagDelayPlant& p, double Tc) { return simc_pi({p.K, p.T + p.tau / 3, p.tau}, Tc); }

StandardForm imc_pi(const IntegratingPlant& p, double Tc) {
  const double sum = Tc + p.tau, Ti = 2 * Tc + p.tau;
  return {.Kc = Ti / (p.k * sum * sum), .Ti = Ti, .TD = 0};
}

Ultimate ultimate(const IntegratingPlant& p) { return {kPi / (2 * p.k * p.tau), 4 * p.tau}; }

Ultimate ultimate(const LagDelayPlant& p) {
  // tau w + arctan(T w) = pi, rising in w; the root lies below pi/tau and above half of it.
  double low = kPi / (2 * p.tau), high = kPi / p.tau;
  for (int i = 0; i < 100; ++i) {
    const double w = 0.5 * (low + high);
    (p.tau * w + std::atan(p.T * w) < kPi ? low : high) = w;
  }
  return {std::hypot(1.0, p.T * low) / p.K, 2 * kPi / low};
}

StandardForm ziegler_nichols_pi(const Ultimate& u) { return {.Kc = u.gain / 2.2, .Ti = u.period / 1.2, .TD = 0}; }
StandardForm ziegler_nichols_pid(const Ultimate& u) {
  return {.Kc = 0.6 * u.gain, .Ti = u.period / 2, .TD = u.period / 8};
}
StandardForm tyreus_luyben_pi(const Ultimate& u) { return {.Kc = u.gain / 3.2, .Ti = 2.2 * u.period, .TD = 0}; }
StandardForm tyreus_luyben_pid(const Ultimate& u) {
  return {.Kc = u.gain / 2.2, .Ti = 2.2 * u.period, .TD = u.period / 6.3};
}

StandardForm amigo_pi(const LagDelayPlant& p) {
  const double L = p.tau, T = p.T, sum = L + T;
  return {.Kc = (0.15 + (0.35 - L * T / (sum * sum)) * T / L) / p.K,
          .Ti = 0.35 * L + 13 * L * T * T / (T * T + 12 * L * T + 7 * L * L),
          .TD = 0};
}
StandardForm amigo_pi(const IntegratingPlant& p) {
  return {.Kc = 0.35 / (p.k * p.tau), .Ti = 13.4 * p.tau, .TD = 0};
}

StandardForm amigo_pid(const LagDelayPlant& p) {
  const double L = p.tau, T = p.T;
  return {.Kc = (0.2 + 0.45 * T / L) / p.K,
          .Ti = (0.4 * L + 0.8 * T) / (L + 0.1 * T) * L,
          .TD = 0.5 * L * T / (0.3 * L + T)};
}
StandardForm amigo_pid(const IntegratingPlant& p) {
  return {.Kc = 0.45 / (p.k * p.tau), .Ti = 8 * p.tau, .TD = 0.5 * p.tau};
}

}  // namespace portrait::rules
