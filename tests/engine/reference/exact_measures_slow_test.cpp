#include "tests/engine/reference/exact_measures_test.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

/// tau_f from 1e-4 to 1e-2, where the controller's slope of y costs the most digits.
TEST(ExactMeasuresSlow, OfLoopsWithTinyFilters) {
  oracle::Random random(51);
  for (int trial = 0; trial < 10; ++trial) {
    Loop loop = oracle::random_stable_loop(random, trial % 4 == 3 ? Plant::ipdt : Plant::dipdt, 1 + trial % 4,
                                           static_cast<Prefilter>(random.below(3)));
    loop.setting.tau_f = random.log_uniform(1e-4, 1e-2);
    if (!is_stable(open_loop(loop))) continue;
    expect_exact_measures(loop, pieces_for(loop), 20, kPromise);
  }
}

TEST(ExactMeasuresSlow, OfPlantsWithTinyAndLongLags) {
  oracle::Random random(52);
  for (int trial = 0; trial < 12; ++trial) {
    const double tau_1 = trial % 2 == 0 ? random.log_uniform(1e-3, 0.1) : random.log_uniform(10, 100);
    const Loop loop{
        {Plant::fotd, trial % 3, Prefilter::full},
        {.kappa = 0.4 * (1 + tau_1), .tau_i = 1 + tau_1, .delta = 0.3 * tau_1, .tau_1 = tau_1, .tau_f = 0.05}};
    if (!is_stable(open_loop(loop))) continue;
    expect_exact_measures(loop, pieces_for(loop), 20, kPromise);
  }
}

}  // namespace
}  // namespace portrait::reference
