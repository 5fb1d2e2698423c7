#include "engine/rules/step_response_rules.h"

#include <array>
#include <cmath>

#include "engine/rules/reaction_curve.h"

namespace portrait::rules {
namespace {

/// a_0 e^{a_1 tau + a_2 tau^2}
using Fit = std::array<double, 3>;
double at(const Fit& a, double tau) { return a[0] * std::exp(a[1] * tau + a[2] * tau * tau); }

struct KappaTau {
  Fit gain, integral, derivative, weight;
};
constexpr KappaTau kPi14 = {{0.41, -0.23, 0.019}, {5.7, 1.7, -0.69}, {}, {0.33, 2.5, -1.9}};
constexpr KappaTau kPi20 = {{0.81, -1.1, 0.76}, {3.4, 0.28, -0.0089}, {}, {0.78, -1.9, 1.2}};
constexpr KappaTau kPid14 = {{5.6, -8.8, 6.8}, {1.1, 6.7, -4.4}, {1.7, -6.4, 2.0}, {0.12, 6.9, -6.6}};
constexpr KappaTau kPid20 = {{8.6, -7.1, 5.4}, {1.0, 3.3, -2.3}, {0.38, 0.056, -0.60}, {0.56, -2.2, 1.2}};

WeightedPid kappa_tau(double K, const Tangent& tangent, const KappaTau& fit) {
  const double sum = tangent.L + tangent.T, tau = tangent.L / sum;
  return {
      {.Kc = at(fit.gain, tau) / (K * sum), .Ti = at(fit.integral, tau) * sum, .TD = at(fit.derivative, tau) * sum},
      at(fit.weight, tau),
      0};
}

}  // namespace

std::optional<Tangent> steepest_tangent(const Polynomial& N, const Polynomial& D, double Td) {
  if (D.size() == 1) return Tangent{Td, 0};
  const auto curve = reaction_curve(N, D, Td);
  if (!curve) return std::nullopt;
  return Tangent{curve->lag, N[0] / D[0] / curve->slope};
}

WeightedPid kappa_tau_pi(double K, const Tangent& t, bool Ms_2) { return kappa_tau(K, t, Ms_2 ? kPi20 : kPi14); }
WeightedPid kappa_tau_pid(double K, const Tangent& t, bool Ms_2) { return kappa_tau(K, t, Ms_2 ? kPid20 : kPid14); }

WeightedPid taguchi_pi(double K, double L, double T, int lags) {
  if (lags == 0) return {{.Kc = 0.7662 / (K * L), .Ti = 4.091 * L, .TD = 0}, 1 - 0.6810, 0};
  const double x = L / T;
  if (lags == 1)
    return {{.Kc = (0.1787 + 0.2839 / (x + 0.001723)) / (K * T),
             .Ti = (4.296 + 3.794 * x + 0.2591 * x * x) * T,
             .TD = 0},
            1 - (0.6551 + 0.01877 * x),
            0};
  return {{.Kc = (0.07368 + 0.3840 / (x + 0.7640)) / (K * T), .Ti = (8.549 + 4.029 * x) * T, .TD = 0},
          1 - (0.6691 + 0.006606 * x),
          0};
}

WeightedPid taguchi_pid(double K, double L, double T, int lags) {
  if (lags == 0) return {{.Kc = 1.253 / (K * L), .Ti = 2.388 * L, .TD = 0.4137 * L}, 1 - 0.6642, 1 - 0.6797};
  const double x = L / T;
  if (lags == 1)
    return {{.Kc = (0.7608 + 0.5184 / ((x + 0.01308) * (x + 0.01308))) / (K * T),
             .Ti = (0.03330 + (3.997 - 0.5517 * x) * x) * T,
             .TD = (0.03432 + ((0.6878 * x - 1.774) * x + 2.058) * x) * T},
            1 - 0.6647,
            1 - (0.8653 - 0.1277 * x + 0.03330 * x * x)};
  return {{.Kc = (0.1778 + 0.5667 / (x + 0.002325)) / (K * T),
           .Ti = (0.2011 + (((-4.835 * x + 13.70) * x - 14.98) * x + 11.16) * x) * T,
           .TD = (1.262 + 0.3620 * x) * T},
          1 - 0.6666,
          1 - (0.8206 - 0.09750 * x + 0.03845 * x * x)};
}

}  // namespace portrait::rules
