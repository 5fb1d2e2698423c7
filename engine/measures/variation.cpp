#include "engine/measures/variation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/check.h"

namespace portrait {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

/// Best variation of a shape that has come to its k-th extreme, seen from one side of x(inf): the variation
/// so far plus or minus the extreme's value, which is what the next leg adds to.
struct Side {
  double above = kNone;  ///< last extreme above x(inf): variation + value
  double below = kNone;  ///< last extreme below x(inf): variation - value
};

}  // namespace

double total_variation(std::span<const double> x) {
  double sum = 0;
  for (std::size_t i = 1; i < x.size(); ++i) sum += std::abs(x[i] - x[i - 1]);
  return sum;
}

double shape_deviation(std::span<const double> x, double x_infinity, int m) {
  PORTRAIT_CHECK(!x.empty() && m >= 0);
  const double start = x.front();
  double best_shape = std::abs(x_infinity - start);
  std::vector<Side> reached(static_cast<std::size_t>(m) + 1);

  for (const double extreme : x.subspan(1)) {
    if (extreme == x_infinity) continue;  // on neither side: no pulse
    const bool above = extreme > x_infinity;
    const double to_end = std::abs(extreme - x_infinity);
    for (std::size_t k = reached.size() - 1; k >= 1; --k) {
      const double from_start = k == 1 ? std::abs(extreme - start) : kNone;
      const double from_last = above ? reached[k - 1].below + extreme : reached[k - 1].above - extreme;
      const double variation = std::max(from_start, from_last);
      if (variation == kNone) continue;
      best_shape = std::max(best_shape, variation + to_end);
      double& side = above ? reached[k].above : reached[k].below;
      side = std::max(side, above ? variation + extreme : variation - extreme);
    }
  }
  return total_variation(x) + std::abs(x_infinity - x.back()) - best_shape;
}

int alternating_extremes(std::span<const double> x, double x_infinity, double tolerance) {
  PORTRAIT_CHECK(!x.empty());
  const auto side = [&](double deviation) { return deviation > tolerance ? 1 : deviation < -tolerance ? -1 : 0; };
  const double start = x.front() - x_infinity;
  int last = 0, count = 0;
  for (const double point : x.subspan(1)) {
    const double deviation = point - x_infinity;
    const int here = side(deviation);
    if (here == 0 || here == last) continue;
    const bool still_coming =
        last == 0 && here == side(start) && std::abs(deviation) <= std::abs(start) + tolerance;
    if (still_coming) continue;
    last = here;
    ++count;
  }
  return count;
}

}  // namespace portrait
