#include "engine/loop/transfer_function.h"

#include <algorithm>
#include <cmath>

#include "engine/base/check.h"

namespace portrait {
namespace {

/// A quadratic factor whose roots are real falls into two, so that neither hides in the rounding of the other.
void add_quadratic(double c, double b, double a, Factored& into) {
  const double discriminant = b * b - 4 * a * c;
  if (discriminant <= 0) {
    into.factors.push_back({b / c, a / c});
    return;
  }
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  // The roots are q/a and c/q: 1 + T s has its root at -1/T.
  into.factors.push_back({-a / q, 0});
  into.factors.push_back({-q / c, 0});
}

void add_roots(const Polynomial& p, Factored& into) {
  for (const std::complex<double>& root : complex_roots(p)) {
    if (root.imag() < 0) continue;  // its conjugate is taken
    if (root.imag() == 0)
      into.factors.push_back({-1 / root.real(), 0});
    else
      into.factors.push_back({-2 * root.real() / std::norm(root), 1 / std::norm(root)});
  }
}

}  // namespace

TransferFunction transfer_function(Polynomial numerator, Polynomial denominator) {
  denominator = trimmed(std::move(denominator));
  PORTRAIT_CHECK(!denominator.empty());
  TransferFunction G{trimmed(std::move(numerator)), {}};
  const auto lowest = std::find_if(denominator.begin(), denominator.end(), [](double a) { return a != 0; });
  const auto integrators = static_cast<std::size_t>(lowest - denominator.begin());
  const Polynomial rest(lowest, denominator.end());
  if (rest.size() > 1)
    G.denominator.push_back(rest);
  else
    G.numerator = scaled(1 / rest[0], G.numerator);
  G.denominator.insert(G.denominator.end(), integrators, Polynomial{0, 1});
  return G;
}

TransferFunction multiple_lag(double K, double T, int order) {
  return {{K}, std::vector<Polynomial>(static_cast<std::size_t>(order), Polynomial{1, T})};
}

Polynomial written_out(const std::vector<Polynomial>& factors) {
  Polynomial p{1};
  for (const Polynomial& factor : factors) p = product(p, factor);
  return p;
}

int degree(const std::vector<Polynomial>& factors) {
  int sum = 0;
  for (const Polynomial& factor : factors) sum += degree(factor);
  return sum;
}

std::complex<double> value(const Polynomial& p, std::complex<double> s) {
  std::complex<double> sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * s + p[i];
  return sum;
}

std::complex<double> value(const TransferFunction& G, std::complex<double> s) {
  std::complex<double> found = value(G.numerator, s);
  for (const Polynomial& factor : G.denominator) found /= value(factor, s);
  return found;
}

int relative_degree(const TransferFunction& G) {
  return degree(G.numerator) < 0 ? degree(G.denominator) + 1 : degree(G.denominator) - degree(G.numerator);
}

TransferFunction in_time_unit(TransferFunction G, double unit) {
  G.numerator = in_time_unit(std::move(G.numerator), unit);
  for (Polynomial& factor : G.denominator) factor = in_time_unit(std::move(factor), unit);
  return G;
}

std::optional<std::string> why_invalid(const TransferFunction& G) {
  const auto finite = [](const Polynomial& p) {
    return std::all_of(p.begin(), p.end(), [](double a) { return std::isfinite(a); });
  };
  if (!finite(G.numerator) || !std::all_of(G.denominator.begin(), G.denominator.end(), finite))
    return "a coefficient is not finite";
  for (const Polynomial& factor : G.denominator)
    if (factor.size() < 2 || factor.back() == 0) return "the highest coefficient of a denominator is 0";
  return std::nullopt;
}

Factored factored(const std::vector<Polynomial>& factors) {
  Factored found;
  for (const Polynomial& given : factors) {
    const auto first = std::find_if(given.begin(), given.end(), [](double a) { return a != 0; });
    PORTRAIT_CHECK(first != given.end());
    const Polynomial p = trimmed(Polynomial(first, given.end()));
    found.power += static_cast<int>(first - given.begin());
    found.lowest *= p[0];
    if (p.size() == 2) found.factors.push_back({p[1] / p[0], 0});
    if (p.size() == 3) add_quadratic(p[0], p[1], p[2], found);
    if (p.size() > 3) add_roots(p, found);
  }
  return found;
}

}  // namespace portrait
