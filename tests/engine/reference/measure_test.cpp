/// What the measures are, on responses that can be known or sampled.

#include "engine/reference/measure.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/margins.h"
#include "engine/loop/noise_gain.h"
#include "engine/loop/parameters.h"
#include "engine/loop/sensitivity.h"
#include "engine/measures/step_measures.h"
#include "engine/measures/variation.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

using enum Measure;
using Signal = double (*)(const StepResponse&, double);

std::vector<Loop> some_loops() {
  return {{{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.1248, .tau_i = 10.324, .delta = 0.5045, .tau_f = 0.1}},
          {{Plant::dipdt, 0, Prefilter::none}, {.kappa = 0.24, .tau_i = 8, .delta = 0.7}},
          {{Plant::ipdt, 2, Prefilter::pi}, {.kappa = 0.7, .tau_i = 5, .delta = 0.2, .tau_f = 0.1, .b = 0.6}},
          {{Plant::fotd, 1, Prefilter::full},
           {.kappa = 1.5, .tau_i = 3, .delta = 0.5, .tau_1 = 2, .tau_f = 0.1, .b = 2}}};
}

/// A signal at 4000 instants a dead time.
std::vector<double> samples(const StepResponse& response, Signal signal, double from, double to) {
  std::vector<double> x;
  const int count = static_cast<int>(std::lround((to - from) * 4000));
  for (int i = 0; i < count; ++i) x.push_back(signal(response, from + (i + 0.5) * (to - from) / count));
  return x;
}

double sampled_variation(const std::vector<double>& x) {
  double sum = std::abs(x.front());
  for (std::size_t i = 1; i < x.size(); ++i) sum += std::abs(x[i] - x[i - 1]);
  return sum;
}

double largest_magnitude(const std::vector<double>& x) {
  double most = 0;
  for (const double value : x) most = std::max(most, std::abs(value));
  return most;
}

TEST(MeasureIae, IsTheIntegralOfTheError) {
  for (const Loop& loop : some_loops()) {
    SCOPED_TRACE(simulate_command(loop));
    const Response r = simulate(loop, Horizon::fixed(20));
    const MeasureRow row = measure(loop, r).measures;
    double w = 0, d = 0;
    for (const double y : samples(r.steps[kSetpoint], y_at, 0, 20)) w += std::abs(1 - y) / 4000;
    for (const double y : samples(r.steps[kDisturbance], y_at, 0, 20)) d += std::abs(y) / 4000;
    EXPECT_NEAR(row[IAE_w], w, 1e-6 * w);
    EXPECT_NEAR(row[IAE_d], d, 1e-6 * d);
  }
}

void expect_from_below(double found, double sampled) {
  EXPECT_GE(found, sampled * (1 - 1e-12));
  EXPECT_LE(found, sampled * 1.002);
}

TEST(MeasureTv, IsTheLimitOfSampledVariationsFromBelow) {
  for (const Loop& loop : some_loops()) {
    SCOPED_TRACE(simulate_command(loop));
    const Response r = simulate(loop, Horizon::fixed(20));
    const MeasureRow row = measure(loop, r).measures;
    const std::vector<double> yw = samples(r.steps[kSetpoint], y_at, 0, 20),
                              uw = samples(r.steps[kSetpoint], u_at, 0, 20),
                              yd = samples(r.steps[kDisturbance], y_at, 0, 20),
                              ud = samples(r.steps[kDisturbance], u_at, 0, 20);
    expect_from_below(row[TV_yw], sampled_variation(yw));
    expect_from_below(row[TV_uw], sampled_variation(uw));
    expect_from_below(row[TV_yd], sampled_variation(yd));
    expect_from_below(row[TV_ud], sampled_variation(ud));
    expect_from_below(row[y_max_w], largest_magnitude(yw));
    expect_from_below(row[u_max_w], largest_magnitude(uw));
    expect_from_below(row[y_max_d], largest_magnitude(yd));
    expect_from_below(row[u_max_d], largest_magnitude(ud));
  }
}

/// ipdt under P with kappa < 1/e never overshoots: e = u/kappa, and all of u is needed once.
TEST(MeasureShapes, OfAMonotonicLoopAreKnown) {
  const double kappa = 0.2;
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = kappa}};
  const Measured measured = measure(loop, Horizon::until_settled());
  const MeasureRow& row = measured.measures;
  EXPECT_EQ(measured.status, Status::settled);
  EXPECT_NEAR(row[IAE_w], 1 / kappa, 1e-9);
  EXPECT_TRUE(std::isnan(row[IAE_d])) << "an error of 1/kappa stays";
  for (const Measure m : {TV_yw, y_max_w, TV_ud, u_max_d}) EXPECT_NEAR(row[m], 1, 1e-9) << to_string(m);
  for (const Measure m : {TV_yd, y_max_d}) EXPECT_NEAR(row[m], 1 / kappa, 1e-8) << to_string(m);
  EXPECT_NEAR(row[TV_uw], 2 * kappa, 1e-9) << "the jump at 0+ counts";
  EXPECT_NEAR(row[TV0_uw], 2 * kappa, 1e-9);
  EXPECT_NEAR(row[u_max_w], kappa, 1e-15);
  for (const Measure m : {TV0_yw, TV1_yw, TV2_yw, TV1_uw, TV2_uw, TV0_yd, TV1_yd, TV2_yd, TV0_ud, TV1_ud, TV2_ud})
    EXPECT_NEAR(row[m], 0, 1e-8) << to_string(m);
}

TEST(MeasureShapes, CutOffEarlyStillEndAtTheSteadyState) {
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.2}};
  const MeasureRow row = measure(loop, Horizon::fixed(4)).measures;
  EXPECT_LT(row[TV_yw], 0.6);
  EXPECT_NEAR(row[TV0_yw], 0, 1e-12);
  EXPECT_NEAR(row[TV1_uw], 0, 1e-12);
}

TEST(MeasureShapes, AreNeverNegativeAndFallWithM) {
  oracle::Random random(71);
  for (int trial = 0; trial < 60; ++trial) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const MeasureRow row = measure(loop, Horizon::fixed(25)).measures;
    const Measure families[][3] = {
        {TV0_yw, TV1_yw, TV2_yw}, {TV0_uw, TV1_uw, TV2_uw}, {TV0_yd, TV1_yd, TV2_yd}, {TV0_ud, TV1_ud, TV2_ud}};
    for (const auto& tv : families) {
      EXPECT_GE(row[tv[2]], 0);
      EXPECT_GE(row[tv[1]], row[tv[2]] - 1e-12);
      EXPECT_GE(row[tv[0]], row[tv[1]] - 1e-12);
    }
  }
}

/// Of y, 500 samples a dead time: small ones as well as those that rest at 1.
TEST(MeasureShapes, AlternateAsTheirSamplesDo) {
  oracle::Random random(73);
  for (int trial = 0; trial < 60; ++trial) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const Response r = simulate(loop, Horizon::fixed(25));
    const MeasureRow row = measure(loop, r).measures;
    for (const auto& [step, name] : {std::pair{kSetpoint, DC_yw}, std::pair{kDisturbance, DC_yd}}) {
      const double rest = r.steps[step].at_rest.y;
      std::vector<double> x = {0};
      for (int i = 0; i <= 25 * 500; ++i) x.push_back(y_at(r.steps[step], i / 500.0));
      double deviation = 0;
      for (const double value : x) deviation = std::max(deviation, std::abs(value - rest));
      EXPECT_EQ(row[name], alternating_extremes(x, rest, kSettlingBand * deviation)) << to_string(name);
    }
  }
}

TEST(SteadyStates, WithIntegralAction) {
  for (const Plant plant : {Plant::dipdt, Plant::ipdt}) {
    const Loop loop{{plant, 0, Prefilter::pi}, {.kappa = 0.2, .tau_i = 8, .delta = 0.5}};
    EXPECT_EQ(steady_state(loop, kSetpoint).y, 1);
    EXPECT_EQ(steady_state(loop, kSetpoint).u, 0);
    EXPECT_EQ(steady_state(loop, kDisturbance).y, 0);
    EXPECT_EQ(steady_state(loop, kDisturbance).u, -1);
  }
  const Loop stable_plant{{Plant::fotd, 0, Prefilter::pi}, {.kappa = 0.2, .tau_i = 8, .tau_1 = 1}};
  EXPECT_EQ(steady_state(stable_plant, kSetpoint).u, 1);
  EXPECT_EQ(steady_state(stable_plant, kDisturbance).u, -1);
}

/// Every combination of plant, integral action, derivative, filter and prefilter comes to rest where it should.
TEST(SteadyStates, AreWhereTheResponsesEnd) {
  for (const Plant plant : {Plant::dipdt, Plant::ipdt, Plant::fotd})
    for (const Prefilter prefilter : {Prefilter::full, Prefilter::pi, Prefilter::none})
      for (const double tau_i : {9.0, kInf})
        for (const int n : {0, 2}) {
          const Loop loop{{plant, n, prefilter},
                          {.kappa = 0.1,
                           .tau_i = tau_i,
                           .delta = plant == Plant::dipdt ? 0.45 : 0.05,
                           .tau_1 = 1.5,
                           .tau_f = 0.05}};
          SCOPED_TRACE(simulate_command(loop));
          const Response r = simulate(loop, Horizon::until_settled());
          ASSERT_TRUE(r.quiet);
          for (const StepResponse& step : std::span(r.steps).first(2)) {
            EXPECT_NEAR(y_at(step, r.horizon), step.at_rest.y, 1e-7 * std::max(1.0, std::abs(step.at_rest.y)));
            EXPECT_NEAR(u_at(step, r.horizon), step.at_rest.u, 1e-7);
          }
        }
}

TEST(MeasureIae, DoesNotExistWhereAnErrorStays) {
  const MeasureRow pd = measure({{Plant::dipdt, 1, Prefilter::full}, {.kappa = 0.08, .delta = 0.46, .tau_f = 0.1}},
                                Horizon::fixed(30))
                            .measures;
  EXPECT_FALSE(std::isnan(pd[IAE_w]));
  EXPECT_TRUE(std::isnan(pd[IAE_d]));
  const MeasureRow p =
      measure({{Plant::fotd, 0, Prefilter::none}, {.kappa = 0.8, .tau_1 = 2}}, Horizon::fixed(30)).measures;
  EXPECT_TRUE(std::isnan(p[IAE_w]));
  EXPECT_TRUE(std::isnan(p[IAE_d]));
  EXPECT_NEAR(p[y_max_w], 0.8 / 1.8, 0.02) << "all else exists";
}

TEST(MeasureRowOf, EveryStableLoopIsFiniteButForSuchErrors) {
  oracle::Random random(72);
  for (int trial = 0; trial < 60; ++trial) {
    const Loop loop = oracle::random_stable_loop(random);
    SCOPED_TRACE(simulate_command(loop));
    const bool integral = has_integral_action(loop.setting), integrating = integrators(loop.family.plant) > 0;
    const MeasureRow row = measure(loop, Horizon::fixed(10)).measures;
    for (const Measure m : all_measures()) {
      if (m == Measure::noise_gain || is_noisy(m) || info(m).step == 'o') continue;  // none was asked for
      const bool of_error = to_string(m).starts_with("I");
      const bool exists = !of_error || integral || (info(m).step == 'w' && integrating);
      EXPECT_EQ(std::isnan(row[m]), !exists) << to_string(m);
      const bool may_be_inf = m == Ms_omega || m == Mt_omega || m == PM || m == DM;
      EXPECT_TRUE(!std::isinf(row[m]) || may_be_inf) << to_string(m);
    }
    EXPECT_EQ(row[Ms], sensitivity_peak(open_loop(loop)).value);
    EXPECT_EQ(row[Mt], complementary_sensitivity_peak(open_loop(loop)).value);
    EXPECT_EQ(row[Ms_omega], sensitivity_peak(open_loop(loop)).omega);
    EXPECT_EQ(row[Mt_omega], complementary_sensitivity_peak(open_loop(loop)).omega);
    const Margins m = margins(open_loop(loop));
    EXPECT_EQ((std::array{row[GM], row[GM_low], row[PM], row[DM]}),
              (std::array{m.gain, m.gain_low, m.phase_deg, m.delay}));
  }
}

TEST(MeasureRowOf, TheNoiseGainNeedsASamplingTime) {
  const Loop loop = some_loops().front();
  EXPECT_TRUE(std::isnan(measure(loop, Horizon::fixed(10)).measures[Measure::noise_gain]));
  EXPECT_EQ(measure(loop, Horizon::fixed(10), {}, 0.1).measures[Measure::noise_gain],
            portrait::noise_gain(loop, 0.1));
}

/// Deviation from rest over the last `length` before T, relative to the largest before T.
double last_deviation(const Response& r, double T, double length) {
  double worst = 0;
  for (const StepResponse& step : std::span(r.steps).first(2))
    for (const bool of_y : {true, false}) {
      const Signal signal = of_y ? y_at : u_at;
      const double rest = of_y ? step.at_rest.y : step.at_rest.u;
      double all = std::abs(rest), last = 0;
      for (int i = 0; i <= static_cast<int>(200 * T); ++i)
        all = std::max(all, std::abs(signal(step, i / 200.0) - rest));
      for (int i = 0; i < 2000; ++i)
        last = std::max(last, std::abs(signal(step, T - length + length * i / 2000) - rest));
      worst = std::max(worst, last / all);
    }
  return worst;
}

TEST(MeasureStatus, SettledIsWithinTheBandOverTheWholeLastDeadTime) {
  for (const Loop& loop : some_loops()) {
    SCOPED_TRACE(simulate_command(loop));
    const Response r = simulate(loop, Horizon::fixed(60));
    int changes = 0;
    Status last = Status::not_settled;
    for (int T = 2; T <= 60; T += 2) {
      const double deviation = last_deviation(r, T, 1);
      if (std::abs(deviation - kSettlingBand) < 1e-4) continue;
      const Status status = measure(loop, Horizon::fixed(T)).status;
      EXPECT_EQ(status, deviation <= kSettlingBand ? Status::settled : Status::not_settled) << T;
      changes += status != last ? 1 : 0;
      last = status;
    }
    EXPECT_EQ(last, Status::settled);
    EXPECT_GE(changes, 1);
  }
}

/// P control of 1/(s + 1), which decays, and of 1/(s (s + 1)), which swings.
TEST(MeasureStatus, WithoutDeadTimeIsThatOfTheLastTenth) {
  const std::vector<std::pair<Polynomial, double>> loops = {{{1, 1}, 1}, {{0, 1, 1}, 4}};
  for (const auto& [denominator, gain] : loops) {
    const GeneralLoop loop{{transfer_function({1}, denominator), 0}, controller(transfer_function({gain}, {1}))};
    int settled = 0, not_settled = 0;
    for (double T = 1; T <= 16; T += 0.25) {
      const double deviation = last_deviation(simulate(loop, Horizon::fixed(T)), T, 0.1 * T);
      if (std::abs(deviation - kSettlingBand) < 0.02 * kSettlingBand) continue;
      const bool wanted = deviation <= kSettlingBand;
      ++(wanted ? settled : not_settled);
      EXPECT_EQ(measure(loop, Horizon::fixed(T)).status, wanted ? Status::settled : Status::not_settled)
          << gain << ", " << T << ": " << deviation;
    }
    EXPECT_GT(settled, 10);
    EXPECT_GT(not_settled, 4);
  }
}

TEST(MeasureStatus, OfAnAutomaticHorizonThatGaveUpIsNotSettledEvenWithinTheBand) {
  const Loop loop = some_loops().front();
  Response r = simulate(loop, Horizon::fixed(60));
  ASSERT_EQ(measure(loop, r).status, Status::settled);
  r.quiet = false;
  EXPECT_EQ(measure(loop, r).status, Status::not_settled);
}

TEST(MeasureStatus, OfAHorizonThatEndsBeforeAnythingHappens) {
  const Loop loop{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.2}};
  EXPECT_EQ(measure(loop, Horizon::fixed(0.5)).status, Status::not_settled);
}

}  // namespace
}  // namespace portrait::reference
