#include "engine/reference/error_integrals.h"

#include <cmath>

namespace portrait::reference {
namespace {

double integral(const Series& f) { return value(antiderivative(f), 1); }

/// Integral of |f|, given where f changes sign.
double integral_of_magnitude(const Series& f, const std::vector<double>& changes) {
  const Series integral = antiderivative(f);
  double last = 0, sum = 0;
  for (const double x : changes) {
    const double here = value(integral, x);
    sum += std::abs(here - last);
    last = here;
  }
  return sum + std::abs(value(integral, 1) - last);
}

/// t as a series of the panel's own x.
Series time_of(const Piece& piece) {
  const double half = 0.5 * piece.length;
  return Series{{piece.start + half, half}};
}

}  // namespace

ErrorIntegrals error_integrals(const std::vector<Piece>& pieces, double target, double noise) {
  ErrorIntegrals sum;
  for (const Piece& piece : pieces) {
    Series e = -piece.y;
    e(0) += target;
    const Series t = time_of(piece), squared = product(e, e);
    const std::vector<double> changes = sign_changes(e, noise);
    const double dt = 0.5 * piece.length;
    sum.IAE += dt * integral_of_magnitude(e, changes);
    sum.ISE += dt * integral(squared);
    sum.ITAE += dt * integral_of_magnitude(product(t, e), changes);
    sum.ITSE += dt * integral(product(t, squared));
  }
  return sum;
}

}  // namespace portrait::reference
