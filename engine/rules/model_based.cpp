#include "engine/rules/model_based.h"

#include <algorithm>

namespace portrait::rules {
namespace {

Quotient dead_time(double Td, DeadTimeQuotient quotient) {
  switch (quotient) {
    case DeadTimeQuotient::taylor:
      return {{1, -Td}, {1}};
    case DeadTimeQuotient::pade_1:
      return {{1, -Td / 2}, {1, Td / 2}};
    case DeadTimeQuotient::pade_2:
      break;
  }
  return {{1, -Td / 2, Td * Td / 12}, {1, Td / 2, Td * Td / 12}};
}

Polynomial times(double factor, Polynomial p) {
  for (double& coefficient : p) coefficient *= factor;
  return p;
}

}  // namespace

Polynomial lag_power(double T, int n) {
  Polynomial p{1};
  for (int i = 0; i < n; ++i) p = product(p, {1, T});
  return p;
}

Quotient model_based_controller(const LagPlant& plant, double Tc, DeadTimeQuotient quotient) {
  const auto [N, D] = dead_time(plant.Td, quotient);
  Polynomial rest = difference(product(lag_power(Tc, std::max(plant.j, 1)), D), N);
  rest[0] = 0;  // 1 - 1
  return {product(lag_power(plant.Tj, plant.j), D), times(plant.K, rest)};
}

Quotient step_prefilter(const LagPlant& plant, double Tc) {
  return {lag_power(Tc, plant.j), lag_power(plant.Tj, plant.j)};
}

Quotient smooth_prefilter(const LagPlant& plant, int order) { return {{1}, lag_power(plant.Tj, order)}; }

}  // namespace portrait::rules
