#include "engine/loop/polynomial.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/engine/loop/random_loops.h"

namespace portrait {
namespace {

Polynomial with_roots(const std::vector<double>& roots) {
  Polynomial p{1};
  for (const double root : roots) p = product(p, {-root, 1});
  return p;
}

void expect_roots(const std::vector<double>& found, const std::vector<double>& expected, double relative) {
  ASSERT_EQ(found.size(), expected.size()) << testing::PrintToString(found);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], relative * expected[i]) << i;
}

TEST(Polynomial, ArithmeticByHand) {
  EXPECT_EQ(value({1, 2, 3}, 2), 17);
  EXPECT_EQ(value({}, 2), 0);
  EXPECT_EQ(derivative({1, 2, 3}), (Polynomial{2, 6}));
  EXPECT_EQ(derivative({5}), Polynomial{});
  EXPECT_EQ(product({1, 1}, {-1, 1}), (Polynomial{-1, 0, 1}));
  EXPECT_EQ(product({}, {1, 2}), Polynomial{});
  EXPECT_EQ(difference({1, 2}, {1, 0, 3}), (Polynomial{0, 2, -3}));
}

TEST(SignChanges, OfWhatHasNone) {
  EXPECT_TRUE(positive_sign_changes({}).empty());
  EXPECT_TRUE(positive_sign_changes({0, 0}).empty());
  EXPECT_TRUE(positive_sign_changes({3}).empty());
  EXPECT_TRUE(positive_sign_changes({1, 1}).empty());
  EXPECT_TRUE(positive_sign_changes({1, 0, 1}).empty());
  EXPECT_TRUE(positive_sign_changes(with_roots({-1, -2, -3})).empty());
}

TEST(SignChanges, OfALine) {
  expect_roots(positive_sign_changes({-3, 2}), {1.5}, 4e-16);
  expect_roots(positive_sign_changes({3, -2}), {1.5}, 4e-16);
}

TEST(SignChanges, ARootAtZeroIsNotPositive) {
  expect_roots(positive_sign_changes(with_roots({0, 0, 2})), {2}, 4e-16);
  EXPECT_TRUE(positive_sign_changes({0, 0, 1}).empty());
}

TEST(SignChanges, LeadingZerosSayNothing) { expect_roots(positive_sign_changes({-2, 1, 0, 0}), {2}, 4e-16); }

TEST(SignChanges, RootsManyDecadesApart) {
  const std::vector<double> roots{1e-12, 1e-7, 1e-3, 1, 1e5, 1e11};
  expect_roots(positive_sign_changes(with_roots(roots)), roots, 1e-14);
}

TEST(SignChanges, RootsAtTheEndsOfTheNumberRange) {
  expect_roots(positive_sign_changes({-1e-200, 1e100}), {1e-300}, 1e-15);
  expect_roots(positive_sign_changes({-1e200, 1e-100}), {1e300}, 1e-15);
}

TEST(SignChanges, EvenMultiplicityIsNone) {
  EXPECT_TRUE(positive_sign_changes(with_roots({2, 2})).empty());
  expect_roots(positive_sign_changes(with_roots({1, 1, 3})), {3}, 4e-15);
  expect_roots(positive_sign_changes(with_roots({1, 4, 4, 4, 4})), {1}, 4e-15);
}

TEST(SignChanges, OddMultiplicityIsOneAsSharpAsThePolynomialItself) {
  expect_roots(positive_sign_changes(with_roots({2, 2, 2})), {2}, 1e-4);
  expect_roots(positive_sign_changes(with_roots({0.5, 2, 2, 2})), {0.5, 2}, 1e-4);
}

TEST(SignChanges, NeighboursAThousandthApart) {
  expect_roots(positive_sign_changes(with_roots({1, 1.001, 5})), {1, 1.001, 5}, 1e-11);
}

/// Positive roots at least 5 % apart, negative roots and complex pairs anywhere.
TEST(SignChanges, OfRandomProductsOfFactors) {
  RandomLoops random(4);
  for (int trial = 0; trial < 2000; ++trial) {
    Polynomial p{random.chance(0.5) ? 1.0 : -1.0};
    std::vector<double> roots;
    double root = random.log_uniform(1e-4, 1);
    for (int i = random.index(6); i > 0; --i, root *= random.log_uniform(1.05, 100)) roots.push_back(root);
    for (const double r : roots) p = product(p, {-r, 1});
    for (int i = random.index(3); i > 0; --i) p = product(p, {random.log_uniform(1e-3, 1e3), 1});
    for (int i = random.index(3); i > 0; --i) {
      const double size = random.log_uniform(1e-2, 1e2), angle = random.uniform(0.3, 3.1);
      p = product(p, {size * size, -2 * size * std::cos(angle), 1});
    }
    expect_roots(positive_sign_changes(p), roots, 1e-6);
  }
}

TEST(ComplexRoots, AreThoseOfTheFactors) {
  // (x - 2)(x^2 + 2 x + 5) x, twelve decades away: x -> 1e12 x
  Polynomial p = product(product({-2, 1}, {5, 2, 1}), {0, 1});
  for (std::size_t i = 0; i < p.size(); ++i) p[i] *= std::pow(1e-12, static_cast<double>(i));
  const auto roots = complex_roots(p);
  ASSERT_EQ(roots.size(), 3u);
  for (const std::complex<double> expected : {std::complex(2.0, 0.0), {-1.0, 2.0}, {-1.0, -2.0}}) {
    const auto near = [&](std::complex<double> root) { return std::abs(1e-12 * root - expected) < 1e-12; };
    EXPECT_TRUE(std::any_of(roots.begin(), roots.end(), near)) << expected;
  }
}

TEST(ComplexRoots, OfAConstantAreNone) {
  EXPECT_TRUE(complex_roots({}).empty());
  EXPECT_TRUE(complex_roots({3}).empty());
  EXPECT_TRUE(complex_roots({0, 3}).empty());
}

}  // namespace
}  // namespace portrait
