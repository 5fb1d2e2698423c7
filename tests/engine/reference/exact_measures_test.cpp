#include "tests/engine/reference/exact_measures_test.h"

#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

using oracle::Random;

constexpr Promise kPolynomial = {1e-12, 1e-9};

TEST(ExactMeasures, OfRetardedPolynomialLoops) {
  expect_exact_measures({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.5}}, 1, 15, kPolynomial);
  expect_exact_measures({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.7, .tau_i = 5}}, 1, 15, kPolynomial);
  expect_exact_measures({{Plant::dipdt, 0, Prefilter::none}, {.kappa = 0.08, .delta = 0.46}}, 1, 15, kPolynomial);
  expect_exact_measures({{Plant::dipdt, 0, Prefilter::none}, {.kappa = 0.24, .tau_i = 8, .delta = 0.7}}, 1, 15,
                        kPolynomial);
}

/// Ideal derivatives: u jumps at every dead time, and each jump counts.
TEST(ExactMeasures, OfNeutralLoops) {
  expect_exact_measures({{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.5, .delta = 0.4}}, 1, 15, kPolynomial);
  expect_exact_measures({{Plant::ipdt, 0, Prefilter::pi}, {.kappa = 0.3, .tau_i = 7, .delta = 0.6, .b = 0.5}}, 1,
                        15, kPolynomial);
  expect_exact_measures({{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.9, .tau_i = 3, .delta = 0.8, .tau_1 = 2}},
                        1, 15, kPolynomial);
  expect_exact_measures({{Plant::fotd, 0, Prefilter::pi}, {.kappa = 0.5, .tau_i = 2, .delta = 0.05, .tau_1 = 0.1}},
                        5, 15, kPolynomial);
}

/// Every family; time constants down to 0.02, so that it takes no more than seconds.
TEST(ExactMeasures, OfRandomLoops) {
  Random random(31);
  for (int trial = 0; trial < 45; ++trial) {
    Loop loop = oracle::random_stable_loop(random, static_cast<Plant>(trial % 3), trial % 5,
                                           static_cast<Prefilter>(random.below(3)));
    loop.setting.tau_f = std::max(loop.setting.tau_f, 0.02);
    if (pieces_for(loop) > 13 || !is_stable(open_loop(loop))) continue;
    expect_exact_measures(loop, pieces_for(loop), 15, kPromise);
  }
}

}  // namespace
}  // namespace portrait::reference
