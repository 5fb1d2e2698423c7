#include "engine/reference/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/oracle/random.h"

namespace portrait::reference {
namespace {

using oracle::Random;
using Function = std::function<long double(long double)>;

/// Coefficients by the discrete cosine sum over Chebyshev points of the first kind, in long double.
Series series_of(const Function& f, int degree) {
  const int size = degree + 1;
  Series c(size);
  for (int k = 0; k < size; ++k) {
    long double sum = 0;
    for (int j = 0; j < size; ++j) {
      const long double angle = std::numbers::pi_v<long double> * (j + 0.5L) / size;
      sum += f(std::cos(angle)) * std::cos(k * angle);
    }
    c(k) = static_cast<double>(sum * (k == 0 ? 1 : 2) / size);
  }
  return c;
}

Function with_roots(std::vector<double> roots) {
  return [roots = std::move(roots)](long double x) {
    long double product = 1;
    for (const double root : roots) product *= x - root;
    return product;
  };
}

Series series_with_roots(const std::vector<double>& roots) {
  return series_of(with_roots(roots), static_cast<int>(roots.size()) + 3);
}

/// Increasing, at least `gap` apart.
std::vector<double> separated_roots(Random& random, int count, double gap) {
  std::vector<double> roots;
  while (static_cast<int>(roots.size()) < count) {
    const double candidate = random.uniform(-0.98, 0.98);
    const bool far =
        std::all_of(roots.begin(), roots.end(), [&](double root) { return std::abs(root - candidate) >= gap; });
    if (far) roots.push_back(candidate);
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

void expect_roots(const std::vector<double>& found, const std::vector<double>& roots, double tolerance) {
  ASSERT_EQ(found.size(), roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) EXPECT_NEAR(found[i], roots[i], tolerance);
}

long double wave(long double x) { return std::sin(5 * x + 1) + x * x; }
long double wave_slope(long double x) { return 5 * std::cos(5 * x + 1) + 2 * x; }
long double wave_integral(long double x) {
  return (std::cos(-4.0L) - std::cos(5 * x + 1)) / 5 + (x * x * x + 1) / 3;
}

TEST(ChebyshevValue, IsTheSumOfCosines) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    Series c(1 + random.below(25));
    for (double& coefficient : c) coefficient = random.uniform(-1, 1);
    const double x = random.uniform(-1, 1);
    long double sum = 0;
    for (Eigen::Index k = 0; k < c.size(); ++k)
      sum += c(k) * std::cos(static_cast<long double>(k) * std::acos(static_cast<long double>(x)));
    EXPECT_NEAR(value(c, x), static_cast<double>(sum), 1e-13);
  }
}

TEST(ChebyshevValue, AtTheEndsIsThePlainAndTheAlternatingSum) {
  Series c(5);
  c << 1, 2, 3, 4, 5;
  EXPECT_EQ(value(c, 1), 15);
  EXPECT_EQ(value(c, -1), 3);
}

TEST(ChebyshevDerivative, OfASmoothFunction) {
  const Series slope = derivative(series_of(wave, 30));
  EXPECT_EQ(slope.size(), 30);
  for (const double x : {-1.0, -0.77, 0.0, 0.31, 1.0})
    EXPECT_NEAR(value(slope, x), static_cast<double>(wave_slope(x)), 2e-13);
}

TEST(ChebyshevDerivative, OfAConstantIsEmpty) { EXPECT_EQ(derivative(Series::Ones(1)).size(), 0); }

TEST(ChebyshevAntiderivative, OfASmoothFunctionFromTheLeftEnd) {
  const Series integral = antiderivative(series_of(wave, 30));
  EXPECT_EQ(integral.size(), 32);
  EXPECT_NEAR(value(integral, -1), 0, 1e-15);
  for (const double x : {-0.77, 0.0, 0.31, 1.0})
    EXPECT_NEAR(value(integral, x), static_cast<double>(wave_integral(x)), 2e-15);
}

TEST(ChebyshevAntiderivative, OfShortSeries) {
  EXPECT_EQ(value(antiderivative(Series::Ones(1)), 1), 2);
  EXPECT_EQ(value(antiderivative(Series::Unit(2, 1)), 0), -0.5);
}

TEST(ChebyshevAntiderivative, IsUndoneByTheDerivative) {
  Random random(2);
  for (Eigen::Index size = 1; size < 25; ++size) {
    Series c(size);
    for (double& coefficient : c) coefficient = random.uniform(-1, 1);
    EXPECT_LT((derivative(antiderivative(c)) - c).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(ChebyshevRestricted, IsTheSameFunction) {
  Random random(3);
  const Series whole = series_of(wave, 30);
  for (int trial = 0; trial < 50; ++trial) {
    const double from = random.uniform(-1, 0.9), to = random.uniform(from, 1), x = random.uniform(-1, 1);
    const double there = 0.5 * (from + to) + 0.5 * (to - from) * x;
    EXPECT_NEAR(value(restricted(whole, from, to), x), value(whole, there), 2e-14);
  }
}

TEST(ChebyshevRestricted, KeepsAStraightLineAndAConstant) {
  EXPECT_EQ(value(restricted(Series::Unit(2, 1), 0.25, 0.75), 0), 0.5);
  EXPECT_EQ(value(restricted(Series::Constant(1, 7.0), 0.25, 0.75), 0), 7);
}

TEST(ChebyshevBound, IsNowhereExceeded) {
  Random random(4);
  const Series c = series_of(wave, 30);
  for (int i = 0; i < 100; ++i) EXPECT_LE(std::abs(value(c, random.uniform(-1, 1))), bound(c));
}

TEST(SignChanges, AreAllRootsOfARandomPolynomial) {
  Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const auto roots = separated_roots(random, random.below(9), 0.05);
    expect_roots(sign_changes(series_with_roots(roots), 0), roots, 1e-9);
  }
}

TEST(SignChanges, NoneAtARootOfEvenOrder) {
  for (const double root : {0.0, 0.3, -0.5, 0.7182})
    EXPECT_TRUE(sign_changes(series_with_roots({root, root}), 1e-15).empty()) << root;
  expect_roots(sign_changes(series_with_roots({-0.5, 0.3, 0.3}), 1e-15), {-0.5}, 1e-12);
}

/// Whatever rounding makes of the value at the root, where the search halves the panel.
TEST(SignChanges, NoneAtARootOfEvenOrderWhereThePanelIsHalved) {
  Random random(9);
  for (int trial = 0; trial < 300; ++trial) {
    const double outside = random.uniform(1.5, 3), root = 0.25 * (random.below(7) - 3);
    const Series c = random.uniform(-1, 1) * series_with_roots({root, root, outside});
    EXPECT_TRUE(sign_changes(c, 1e-14).empty()) << root;
  }
}

TEST(SignChanges, OneAtARootOfThirdOrder) {
  for (const double root : {0.0, 0.3, -0.5, 0.7182})
    expect_roots(sign_changes(series_with_roots({root, root, root}), 1e-15), {root}, 2e-5);
}

TEST(SignChanges, CountedOnceWhereThePanelIsHalved) {
  Random random(6);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> roots = {-0.5, 0, 0.25, random.uniform(0.3, 0.9), random.uniform(-0.4, -0.1)};
    Series c = series_with_roots(roots);
    c *= random.uniform(-3, 3);
    std::sort(roots.begin(), roots.end());
    expect_roots(sign_changes(c, 0), roots, 1e-9);
  }
}

TEST(SignChanges, ARootAtTheEndOfThePanelIsAtMostThatEnd) {
  Random random(7);
  for (int trial = 0; trial < 500; ++trial) {
    const double inner = random.uniform(-0.9, 0.9);
    const Series c = random.uniform(-3, 3) * series_with_roots({-1, inner, 1});
    int inside = 0;
    for (const double x : sign_changes(c, 0)) {
      if (std::abs(x) > 1 - 1e-12) continue;
      EXPECT_NEAR(x, inner, 1e-12);
      ++inside;
    }
    EXPECT_EQ(inside, 1);
  }
}

TEST(SignChanges, OfAClusterAreToldApartDownToTenMillionths) {
  const std::vector<double> roots = {0.3, 0.30001, 0.30002};
  expect_roots(sign_changes(series_with_roots(roots), 0), roots, 2e-6);
}

TEST(SignChanges, OfATighterClusterAreOddInNumberWhenTheSignIsAnother) {
  Random random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const double root = random.uniform(-0.9, 0.9), gap = random.log_uniform(1e-12, 1e-6);
    const auto found = sign_changes(series_with_roots({root, root + gap, root + 2 * gap}), 1e-15);
    ASSERT_EQ(found.size() % 2, 1u) << root << " " << gap;
    for (const double x : found) EXPECT_NEAR(x, root, 2e-5);
  }
}

TEST(SignChanges, NoneInAFunctionThatIsNoLargerThanTheNoise) {
  const Series small = 1e-14 * Series::Unit(6, 5);
  EXPECT_TRUE(sign_changes(small, 1e-14).empty());
  EXPECT_EQ(sign_changes(small, 1e-16).size(), 5u);
  EXPECT_TRUE(sign_changes(Series::Zero(6), 0).empty());
}

TEST(SignChanges, OfStraightLinesAndConstants) {
  EXPECT_TRUE(sign_changes(Series::Ones(1), 0).empty());
  Series line(2);
  line << -0.5, 1;
  expect_roots(sign_changes(line, 0), {0.5}, 1e-15);
}

TEST(SignChanges, OfAFlatSignalAtRestCostLittle) {
  Series c = series_of([](long double x) { return std::exp(-40 * (x + 1)); }, 60);
  EXPECT_TRUE(sign_changes(c, 1e-13).size() <= 2) << "only where the signal has drowned in rounding";
}

}  // namespace
}  // namespace portrait::reference
