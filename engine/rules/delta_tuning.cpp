#include "engine/rules/delta_tuning.h"

#include <cmath>

#include "engine/loop/polynomial.h"

namespace portrait::rules {

double method_product_f(double cbar) { return (1 + std::sqrt(1 + 4 / (cbar * cbar))) / 2; }

double method_product_a(double cbar) {
  const double root = std::sqrt(method_product_f(cbar));
  return std::atan(root * cbar) / root;
}

StandardForm delta_tuning_by_margin(const IntegratingPlant& plant, double cbar, double dtau_max) {
  const double a = method_product_a(cbar), sum = dtau_max + plant.tau;
  return {.Kc = a / (plant.k * sum), .Ti = cbar / a * sum, .TD = 0};
}

StandardForm delta_tuning(const IntegratingPlant& plant, double cbar, double delta) {
  return delta_tuning_by_margin(plant, cbar, delta * plant.tau);
}

double relative_delay_margin(double alpha, double beta) { return method_product_a(alpha * beta) / alpha - 1; }

StandardForm pade_tuning(const IntegratingPlant& plant, double c) {
  const double alpha = (c + 2.0 / 9) / (c * c * c - 0.5 * c - 1.0 / 9);
  return {.Kc = alpha / (plant.k * plant.tau), .Ti = (3 * c + 2.0 / 3) * plant.tau, .TD = 0};
}

double pade_triple_root() { return positive_sign_changes({-11.0 / 54, -7.0 / 6, -1, 1}).back(); }

}  // namespace portrait::rules
