// The fast path against the reference, on every instruction set.
#include <gtest/gtest.h>

#include "engine/measures/step_measures.h"
#include "tests/engine/kernel/comparison.h"

namespace portrait {
namespace {

class Responses : public ::testing::TestWithParam<const kernel::Implementation*> {};

std::string isa_name(const ::testing::TestParamInfo<const kernel::Implementation*>& isa) { return isa.param->name; }

INSTANTIATE_TEST_SUITE_P(EveryIsa, Responses, ::testing::ValuesIn(available_implementations()), isa_name);

TEST_P(Responses, EqualTheReference) {
  const Errors errors = errors_over(*GetParam(), 100, 1);
  EXPECT_LT(errors.integral.error, 1e-8) << errors.integral.where;
  EXPECT_LT(errors.variation.error, 1e-7) << errors.variation.where;
  EXPECT_EQ(errors.unresolved, 0);
  EXPECT_EQ(errors.status_differs, 0);
}

/// The independently computed loop of the reference's own published test.
TEST_P(Responses, QuadruplePoleWithFilter) {
  const Loop loop{{Plant::dipdt, 1, Prefilter::full},
                  {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1}};
  const auto m = measure_one(*GetParam(), loop, Horizon::fixed(50)).measures;
  EXPECT_NEAR(m[Measure::IAE_w], 10.32551792231, 1e-9);
  EXPECT_NEAR(m[Measure::IAE_d], 82.7361046247, 1e-8);
  EXPECT_NEAR(m[Measure::TV_uw], 0.06862339159280, 1e-11);
  EXPECT_NEAR(m[Measure::TV_ud], 2.4963356025209, 1e-9);
}

/// y_d comes to rest at its largest value within rounding, before the next dead time turns it back: f' is exactly 0 at the
/// edge of a panel.
TEST_P(Responses, AnExtremeAtTheEdgeOfAPanelCounts) {
  const Loop loop{{Plant::fotd, 1, Prefilter::pi},
                  {.kappa = 0.45930299761968585,
                   .delta = 0.007017303482023121,
                   .tau_1 = 0.02564929471004584,
                   .tau_f = 0.1108030840675661}};
  const Horizon horizon = Horizon::fixed(40);
  EXPECT_LT(error_of(measure_one(*GetParam(), loop, horizon).measures[Measure::TV_yd],
                     reference::measure(loop, horizon).measures[Measure::TV_yd]),
            1e-9);
}

/// The integrals of the error against sums over points of the reference's response.
TEST_P(Responses, ErrorIntegralsAreThoseOfTheReferenceResponse) {
  const Loop loop{{Plant::ipdt, 1, Prefilter::full},
                  {.kappa = 0.9, .tau_i = 4, .delta = 0.2, .tau_f = 0.1, .b = 2, .c = 0.5}};
  const MeasureRow fast = measure_one(*GetParam(), loop, Horizon::fixed(30)).measures;
  const auto response = reference::simulate(loop, Horizon::fixed(30));
  const int steps = 600'000;
  for (const auto& [names, step, target] : {std::tuple(kSetpointMeasures, reference::kSetpoint, 1.0),
                                            std::tuple(kDisturbanceMeasures, reference::kDisturbance, 0.0)}) {
    double ISE = 0, ITAE = 0, ITSE = 0;
    for (int i = 0; i < steps; ++i) {
      const double h = 30.0 / steps, t = (i + 0.5) * h, e = target - y_at(response.steps[step], t);
      ISE += h * e * e, ITAE += h * t * std::abs(e), ITSE += h * t * e * e;
    }
    EXPECT_NEAR(fast[names.ISE], ISE, 1e-8);
    EXPECT_NEAR(fast[names.ITAE], ITAE, 1e-8);
    EXPECT_NEAR(fast[names.ITSE], ITSE, 1e-8);
  }
}

TEST_P(Responses, AnAutomaticHorizonGivesTheWholeIntegrals) {
  oracle::Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Loop loop = random_kernel_loop(random);
    const auto fast = measure_one(*GetParam(), loop, Horizon::until_settled());
    const auto slow = reference::measure(loop, Horizon::until_settled());
    EXPECT_EQ(fast.status, slow.status) << simulate_command(loop);
    for (const Measure m : response_measures())
      EXPECT_LT(error_of(fast.measures[m], slow.measures[m]), 1e-7)
          << to_string(m) << " of " << simulate_command(loop);
  }
}

/// The limit of a vanishing filter is the ideal derivative, which knows nothing of filters.
TEST_P(Responses, AVanishingFilterTendsToTheIdealDerivative) {
  const Setting setting{.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 1e-9};
  const auto filtered = measure_one(*GetParam(), {{Plant::dipdt, 1, Prefilter::full}, setting}, Horizon::fixed(30));
  const auto ideal = measure_one(*GetParam(), {{Plant::dipdt, 0, Prefilter::pi}, setting}, Horizon::fixed(30));
  EXPECT_TRUE(filtered.resolved);
  for (const Measure m : {Measure::IAE_d, Measure::ISE_d, Measure::TV_yd, Measure::TV_ud, Measure::TV_uw})
    EXPECT_LT(error_of(filtered.measures[m], ideal.measures[m]), 1e-8) << to_string(m);
}

/// With tau_f above 1 rounding grew from dead time to dead time, where y_w takes derivatives of the filtered error.
TEST_P(Responses, ASlowFilterOverALongTime) {
  oracle::Random random(17);
  const Horizon horizon = Horizon::fixed(300);
  Worst worst;
  for (int i = 0; i < 60; ++i) {
    const auto plant = random.chance(0.6) ? Plant::dipdt : Plant::ipdt;
    const LoopFamily family{plant, 1 + random.below(2), random.chance(0.5) ? Prefilter::none : Prefilter::full};
    Loop loop{family, {}};
    do {
      loop.setting = oracle::random_controller(random, plant, 1);
      loop.setting.tau_f = random.log_uniform(0.3, 5);
      oracle::add_weights(random, family.prefilter, loop.setting);
    } while (!is_stable(open_loop(loop)));
    const auto fast = measure_one(*GetParam(), loop, horizon);
    const auto slow = reference::measure(loop, horizon);
    for (const Measure m : response_measures()) {
      const double part_of = std::max({1e-3, std::abs(slow.measures[m]), variation_of_signal(slow.measures, m)});
      if (std::isfinite(slow.measures[m])) worst.take(std::abs(fast.measures[m] - slow.measures[m]) / part_of, loop, m);
    }
    EXPECT_EQ(fast.status, slow.status) << simulate_command(loop);
  }
  EXPECT_LT(worst.error, 1e-8) << worst.where;
}

/// As the last dead time begins, u jumps from outside the band of what has settled into it.
TEST_P(Responses, WhatUJumpsFromIsOfTheDeadTimeBefore) {
  const Setting of_ipdt{.kappa = 0.781506810999974, .tau_i = 3.959013856355435, .delta = 0.8446961180821273};
  const Setting of_fotd{
      .kappa = 7.823587053846676, .tau_i = kInf, .delta = 6.232086602825467, .tau_1 = 8.598516950533606};
  const std::pair<Loop, double> loops[] = {{{{Plant::ipdt, 0, Prefilter::full}, of_ipdt}, 29},
                                           {{{Plant::fotd, 0, Prefilter::pi}, of_fotd}, 19}};
  for (const auto& [loop, horizon] : loops) {
    EXPECT_EQ(measure_one(*GetParam(), loop, Horizon::fixed(horizon)).status, Status::settled)
        << simulate_command(loop);
    EXPECT_EQ(reference::measure(loop, Horizon::fixed(horizon)).status, Status::settled) << simulate_command(loop);
    EXPECT_EQ(measure_one(*GetParam(), loop, Horizon::fixed(horizon - 1)).status, Status::not_settled);
  }
}

/// A setting's bits do not depend on what stands beside it.
TEST_P(Responses, NeighboursDoNotMatter) {
  const kernel::Implementation& implementation = *GetParam();
  oracle::Random random(9);
  const LoopFamily families[] = {
      {Plant::dipdt, 1, Prefilter::full}, {Plant::fotd, 0, Prefilter::pi}, {Plant::ipdt, 2, Prefilter::pi}};
  for (const LoopFamily& family : families) {
    std::vector<Setting> settings;
    for (int i = 0; i < 3 * implementation.lanes; ++i) {
      settings.push_back(oracle::random_stable_loop(random, family.plant, family.n, family.prefilter).setting);
      if (i < implementation.lanes) settings.back().b = settings.back().c = 0;
    }
    std::vector<kernel::Measured> together(settings.size());
    kernel::measure_responses(implementation, family, settings, Horizon::fixed(25.5), together);
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const auto alone = measure_one(implementation, {family, settings[i]}, Horizon::fixed(25.5));
      for (const Measure m : response_measures()) {
        const double a = together[i].measures[m], b = alone.measures[m];
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << to_string(m) << " in lane " << i;
      }
    }
  }
}

/// Largest difference between instruction sets over random loops, as a part of the signal's variation.
TEST(ResponsesAcrossIsas, AgreeTo12Digits) {
  oracle::Random random(3);
  Worst worst;
  for (int i = 0; i < 600; ++i) {
    const Loop loop = random_kernel_loop(random);
    const auto first = measure_one(*available_implementations().front(), loop, Horizon::fixed(30)).measures;
    for (const auto* implementation : available_implementations()) {
      const auto other = measure_one(*implementation, loop, Horizon::fixed(30)).measures;
      for (const Measure m : response_measures()) {
        const double size = std::max({1e-3, std::abs(first[m]), variation_of_signal(first, m)});
        if (!std::isnan(first[m])) worst.take(std::abs(other[m] - first[m]) / size, loop, m);
      }
    }
  }
  EXPECT_LT(worst.error, 1e-12) << worst.where;
}

}  // namespace
}  // namespace portrait
