/// The noise gain, from frequencies, against the sum over time of what one held pulse of noise does to u.

#include "engine/loop/noise_gain.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/loop/parameters.h"
#include "engine/reference/response.h"
#include "tests/oracle/quadrature.h"
#include "tests/oracle/random_cascades.h"

namespace portrait::reference {
namespace {

/// Without prefilter a step of the setpoint moves u as a step of noise on y does, but for the sign.
StepResponse answer_to_noise(Loop loop) {
  loop.family.prefilter = Prefilter::none;
  loop.setting.b = loop.setting.c = 0;
  return simulate(loop, Horizon::until_settled()).steps[kSetpoint];
}

/// Edges of the pieces and the same a sampling time later: between them both terms below are polynomials.
std::vector<double> edges_of(const std::vector<Piece>& pieces, double sampling) {
  std::vector<double> edges;
  for (const Piece& piece : pieces) {
    edges.push_back(piece.start);
    edges.push_back(piece.start + sampling);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// (1/Ts) int (h(t) - h(t - Ts))^2 dt, the variance of u under independent unit values held for Ts.
double noise_gain_over_time(const Loop& loop, double sampling) {
  static const oracle::GaussRule rule = oracle::gauss_rule(16);
  const StepResponse r = answer_to_noise(loop);
  const double end = r.pieces.back().start + r.pieces.back().length;
  const auto h = [&](double t) { return t < 0 ? 0 : t > end ? r.at_rest.u : u_at(r, t); };
  const std::vector<double> edges = edges_of(r.pieces, sampling);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (edges[i + 1] - edges[i] > 1e-12)
      sum += oracle::integral(rule, edges[i], edges[i + 1], [&](double t) {
        const double pulse = h(t) - h(t - sampling);
        return pulse * pulse;
      });
  return std::sqrt(sum / sampling);
}

void expect_same(const Loop& loop, double sampling) {
  const double expected = noise_gain_over_time(loop, sampling);
  EXPECT_NEAR(noise_gain(loop, sampling), expected, 1e-8 * expected)
      << simulate_command(loop) << " --sampling " << sampling;
}

/// Of so many loops as they are drawn, but for those without a filter, whose noise_gain is infinite.
void expect_same_of(int count, oracle::Random random, Loop (*draw)(oracle::Random&), double least, double greatest) {
  while (count > 0) {
    const Loop loop = draw(random);
    if (loop.family.n == 0 && loop.setting.delta > 0) continue;
    expect_same(loop, random.log_uniform(least, greatest));
    --count;
  }
}

TEST(NoiseGain, IsThatOfASimulatedPulse) {
  expect_same_of(20, oracle::Random(60), [](oracle::Random& random) { return oracle::random_stable_loop(random); }, 0.01,
                 10);
}

/// Plants of many lags, controllers given by their gains.
TEST(NoiseGain, OfTheWiderFamilyToo) {
  expect_same_of(15, oracle::Random(61), [](oracle::Random& random) { return oracle::random_cascade(random); }, 0.02, 5);
}

/// e^{s Ts} against whole powers of e^{-s}: neither dies out.
TEST(NoiseGain, AtWholeDeadTimes) {
  const Loop pid{{Plant::dipdt, 1, Prefilter::none}, {.kappa = 0.12, .tau_i = 10, .delta = 0.5, .tau_f = 0.1}};
  const Loop pi{{Plant::ipdt, 0, Prefilter::none}, {.kappa = 0.7, .tau_i = 5}};
  for (const double sampling : {0.5, 1 - 1e-9, 1.0, 1 + 1e-9, 2.0, 3.0, 7.0, 40.0}) {
    expect_same(pid, sampling);
    expect_same(pi, sampling);
  }
}

}  // namespace
}  // namespace portrait::reference
