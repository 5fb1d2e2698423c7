/// The zero of a continuous function between two points at which its signs differ: false position that halves the weight
/// of an end kept twice (Illinois), with a bisection wherever a value is not finite.
/// accuracy  the width of the last bracket: `tolerance` of its place, or rounding
#pragma once

#include <cmath>

namespace portrait::rules {

template <typename Function>
double root_between(const Function& f, double a, double b, double tolerance) {
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 200 && std::abs(b - a) > tolerance * std::abs(b); ++i) {
    const bool finite = std::isfinite(fa) && std::isfinite(fb);
    double x = finite ? b - fb * (b - a) / (fb - fa) : 0.5 * (a + b);
    if (!(x > std::fmin(a, b) && x < std::fmax(a, b))) x = 0.5 * (a + b);
    const double fx = f(x);
    if (fx == 0) return x;
    if ((fx > 0) == (fb > 0)) {
      b = x, fb = fx, fa *= 0.5;
    } else {
      a = b, fa = fb, b = x, fb = fx;
    }
  }
  return b;
}

}  // namespace portrait::rules
