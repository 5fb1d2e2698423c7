/// Gauss-Legendre quadrature.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace portrait::oracle {

/// Points on [0, 1] and weights whose sum is 1: exact for polynomials up to degree 2 count - 1.
struct GaussRule {
  std::vector<double> at, weight;
};

inline GaussRule gauss_rule(int count) {
  GaussRule rule;
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 0;
    for (int newton = 0; newton < 20; ++newton) {
      double p = 1, before = 0;
      for (int k = 1; k <= count; ++k) {
        const double next = ((2.0 * k - 1) * x * p - (k - 1.0) * before) / k;
        before = p, p = next;
      }
      slope = count * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    rule.at.push_back((x + 1) / 2);
    rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

/// Integral of f from `from` to `to`.
template <typename Function>
double integral(const GaussRule& rule, double from, double to, const Function& f) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.at.size(); ++i) sum += rule.weight[i] * f(from + (to - from) * rule.at[i]);
  return sum * (to - from);
}

}  // namespace portrait::oracle
