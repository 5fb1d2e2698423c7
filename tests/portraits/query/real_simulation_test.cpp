/// Answers in the units of a plant, against a simulation of the real loop in those units.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "engine/sweep/method.h"
#include "portraits/query/measured.h"
#include "portraits/query/query.h"
#include "tests/oracle/random_loops.h"
#include "tests/portraits/query/memory_source.h"
#include "tests/portraits/query/real_loop.h"
#include "tests/portraits/query/small_portraits.h"

namespace portrait {
namespace {

using oracle::Random;

constexpr double kHorizon = 30;

/// A portrait of one setting, as a sweep stores it.
MemorySource portrait_of(const Loop& loop) {
  Grid grid;
  grid.family = loop.family;
  grid.horizon = Horizon::fixed(kHorizon);
  for (const Measure measure : all_measures())
    if (measure != Measure::noise_gain && !why_not_measured(Method::kernel, std::span(&measure, 1)))
      grid.measures.push_back(measure);
  for (const Parameter parameter : parameters_of(loop.family))
    if (parameter != Parameter::tau_d) grid.fixed.push_back({parameter, get(loop.setting, parameter)});
  MemorySource source(grid);
  const Measured stored = measure(grid, {}, std::span(&loop.setting, 1)).front();
  source.status(0) = stored.status;
  for (const Measure measure : grid.measures) source.at(measure, 0) = stored.measures[measure];
  return source;
}

/// What a measure's error is a part of: of a total variation less some pulses the whole of it.
Measure scale_of(Measure measure) {
  const std::string name(to_string(measure));
  return name.starts_with("TV") ? *measure_named("TV_" + name.substr(name.size() - 2)) : measure;
}

/// The measure as the objective of a query.
double answer_of(const MemorySource& source, const QueryUnits& units, Measure measure) {
  Question asked = question(std::string(to_string(measure)));
  asked.conditions.units = units;
  asked.conditions.include_not_settled = true;
  const Answer answer = ask(source, asked);
  return answer.top.empty() ? kNaN : answer.top[0].objective;
}

/// Compares every measure; gives how many there were.
int expect_real(const Loop& loop, const RealPlant& plant, const StepSizes& steps) {
  const MemorySource source = portrait_of(loop);
  const reference::Measured real =
      measured_in_real_units(controller_for(loop, plant), plant, loop.family, Horizon::fixed(kHorizon), steps);
  int compared = 0;
  for (const Measure measure : source.grid().measures) {
    const double found = answer_of(source, {plant, steps}, measure), expected = real.measures[measure];
    EXPECT_EQ(std::isnan(found), std::isnan(expected)) << to_string(measure);
    if (std::isnan(expected)) continue;
    ++compared;
    if (std::isinf(expected))
      EXPECT_EQ(found, expected) << to_string(measure);
    else
      EXPECT_NEAR(found, expected, 1e-8 * real.measures[scale_of(measure)]) << to_string(measure);
  }
  return compared;
}

#ifdef PORTRAIT_SANITIZED
constexpr int kLoops = 10;
#else
constexpr int kLoops = 60;
#endif

void expect_real_loops(Plant family, std::uint64_t seed) {
  Random random(seed);
  int compared = 0;
  for (int i = 0; i < kLoops; ++i) {
    const int n = random.below(4);
    const Loop loop = oracle::random_stable_loop(random, family, n, usual_prefilter(n));
    const double Td = random.log_uniform(0.02, 50), K = random.log_uniform(0.01, 100);
    SCOPED_TRACE(setting_text(loop) + " n=" + std::to_string(n));
    compared += expect_real(loop, {family, random.chance(0.3) ? -K : K, Td, loop.setting.tau_1 * Td},
                            {random.log_uniform(0.1, 10), random.log_uniform(0.1, 10)});
  }
  EXPECT_GT(compared, 28 * kLoops);
}

TEST(RealSimulation, of_dipdt_gives_what_the_query_says) { expect_real_loops(Plant::dipdt, 71); }
TEST(RealSimulation, of_ipdt_gives_what_the_query_says) { expect_real_loops(Plant::ipdt, 72); }
TEST(RealSimulation, of_fotd_gives_what_the_query_says) { expect_real_loops(Plant::fotd, 73); }

}  // namespace
}  // namespace portrait
