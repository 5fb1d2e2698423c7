#include "engine/rules/areas.h"

namespace portrait::rules {
namespace {

double coefficient(const Polynomial& p, std::size_t i) { return i < p.size() ? p[i] : 0; }

/// Maclaurin coefficients of N/D: D times them is N.
std::vector<double> quotient(const Polynomial& N, const Polynomial& D, std::size_t count) {
  std::vector<double> q(count);
  for (std::size_t k = 0; k < count; ++k) {
    double rest = coefficient(N, k);
    for (std::size_t i = 1; i <= k; ++i) rest -= coefficient(D, i) * q[k - i];
    q[k] = rest / D[0];
  }
  return q;
}

}  // namespace

Areas areas_of(const Polynomial& numerator, const Polynomial& denominator, double dead_time, std::size_t count) {
  const std::vector<double> rational = quotient(numerator, denominator, count);
  Areas areas(count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    double delay = 1;  // (-Td)^i/i!
    for (std::size_t i = 0; i <= k; ++i) {
      areas[k] += rational[k - i] * delay;
      delay *= -dead_time / static_cast<double>(i + 1);
    }
    if (k % 2 == 1) areas[k] = -areas[k];
  }
  return areas;
}

Areas filtered(Areas areas, double Tf, int n) {
  for (int order = 0; order < n; ++order)
    for (std::size_t k = 1; k < areas.size(); ++k) areas[k] += Tf * areas[k - 1];
  return areas;
}

}  // namespace portrait::rules
