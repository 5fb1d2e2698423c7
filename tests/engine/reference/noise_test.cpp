/// Measurement noise: against a loop stepped finely, against expectations in closed form, and against the papers.

#include "engine/reference/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "engine/loop/noise_gain.h"
#include "engine/loop/parameters.h"
#include "engine/reference/sampled_loop.h"
#include "tests/oracle/random_loops.h"

namespace portrait::reference {
namespace {

using enum Noise::Kind;

/// PI control of 1/(s + 1), without dead time, in the plainest way: Runge and Kutta's steps, noise held.
Sampled stepped(double Kp, double Ki, const Noise& noise, std::size_t samples) {
  constexpr int kSteps4 = 200;
  double y = 0, integral = 0;
  Sampled found;
  for (std::size_t k = 0; k < samples; ++k) {
    const double n = noise_value(noise, k), h = noise.sampling / kSteps4;
    const auto slope = [&](double of_y, double of_integral) {
      return std::pair(Kp * -(of_y + n) + Ki * of_integral - of_y, -(of_y + n));
    };
    found.u.push_back(Kp * -(y + n) + Ki * integral);
    found.y.push_back(y);
    for (int i = 0; i < kSteps4; ++i) {
      const auto [a1, b1] = slope(y, integral);
      const auto [a2, b2] = slope(y + h / 2 * a1, integral + h / 2 * b1);
      const auto [a3, b3] = slope(y + h / 2 * a2, integral + h / 2 * b2);
      const auto [a4, b4] = slope(y + h * a3, integral + h * b3);
      y += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      integral += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
  }
  return found;
}

TEST(NoiseAnswer, IsThatOfALoopThatIsStepped) {
  const GeneralLoop loop{{multiple_lag(1, 1, 1), 0}, pid_controller({.Kp = 2, .Ki = 3, .Kd = 0})};
  const Response r = simulate(loop, Horizon::until_settled(), {}, kAllSteps);
  for (const Noise::Kind kind : {uniform, gaussian}) {
    const Noise noise{.kind = kind, .amplitude = 0.1, .sampling = 0.05, .seed = 7};
    const NoiseAnswer answer(r, noise.sampling, 10);
    ASSERT_EQ(answer.samples(), 201u);
    const std::vector<double> u = answer.u(noise), y = answer.y(noise);
    const Sampled expected = stepped(2, 3, noise, answer.samples());
    for (std::size_t k = 0; k < u.size(); ++k) {
      EXPECT_NEAR(u[k], expected.u[k], 1e-10) << k;
      EXPECT_NEAR(y[k], expected.y[k], 1e-10) << k;
    }
  }
}

/// The sampled controller, its noise and its dead time, against the recursion written by hand: y' = u(t - 1), Ts = 0.4
/// does not divide the dead time, and a PI controller sums its errors.
TEST(SampledLoop, IsTheRecursion) {
  const GeneralLoop loop{{{{1}, {{0, 1}}}, 1}, pid_controller({.Kp = 0.4, .Ki = 0.1, .Kd = 0})};
  const Noise noise{.amplitude = 0.1, .sampling = 0.4, .seed = 3};
  const Sampled found = simulate_sampled(loop, kSetpoint, 0.4, 20, noise);
  // y(k Ts) = integral of u up to k Ts - 1 = (k - 2.5) Ts: whole holds, and half of one.
  std::vector<double> u;
  double sum = 0;
  for (std::size_t k = 0; k < found.u.size(); ++k) {
    double y = 0;
    for (std::size_t i = 0; i + 2 < k; ++i) y += 0.4 * u[i] * (i + 3 < k ? 1 : 0.5);
    EXPECT_NEAR(found.y[k], y, 1e-13) << k;
    const double e = 1 - y - noise_value(noise, k);
    u.push_back(0.4 * e + 0.1 * 0.4 * sum);
    sum += e;
    EXPECT_NEAR(found.u[k], u[k], 1e-13) << k;
  }
}

/// Finely sampled, a controller is continuous.
TEST(SampledLoop, TendsToTheContinuousOne) {
  const Loop loop{{Plant::dipdt, 2, Prefilter::none}, {.kappa = 0.12, .tau_i = 10, .delta = 0.5, .tau_f = 0.1}};
  const Response r = simulate(loop, Horizon::fixed(20), {}, kAllSteps);
  for (const Step step : kAllSteps) {
    const Sampled fine = simulate_sampled(general(loop), step, 1e-3, 20, std::nullopt);
    for (std::size_t k = 500; k < fine.y.size(); k += 1000)
      EXPECT_NEAR(fine.y[k], y_at(r.steps[step], 1e-3 * static_cast<double>(k)),
                  1e-3 * std::max(1.0, std::abs(fine.y[k])));
  }
}

TEST(NoiseValue, HasTheDistributionAskedFor) {
  for (const Noise::Kind kind : {uniform, gaussian}) {
    const Noise noise{.kind = kind, .amplitude = 0.3, .sampling = 1, .seed = 11};
    constexpr int kCount = 200'000;
    double mean = 0, square = 0, fourth = 0, largest = 0, neighbours = 0;
    for (int k = 0; k < kCount; ++k) {
      const double n = noise_value(noise, static_cast<std::uint64_t>(k));
      mean += n / kCount, square += n * n / kCount, fourth += n * n * n * n / kCount;
      neighbours += n * noise_value(noise, static_cast<std::uint64_t>(k) + 1) / kCount;
      largest = std::max(largest, std::abs(n));
    }
    const double sigma = noise.sigma(), error = 5 / std::sqrt(kCount);
    EXPECT_NEAR(mean, 0, error * sigma);
    EXPECT_NEAR(square, sigma * sigma, 1.5 * error * sigma * sigma);
    EXPECT_NEAR(neighbours, 0, error * sigma * sigma);
    EXPECT_NEAR(fourth / (square * square), kind == uniform ? 1.8 : 3, 0.1);
    EXPECT_LT(largest, kind == uniform ? 0.3 : 0.3 * 6);
  }
  EXPECT_NE(noise_value({.amplitude = 1, .sampling = 1, .seed = 1}, 0),
            noise_value({.amplitude = 1, .sampling = 1, .seed = 2}, 0));
}

/// What is simulated against what is expected: sigma of u, and TV of a loop at rest.
TEST(NoisyMeasures, ComeToTheirExpectations) {
  oracle::Random random(420);
  for (int i = 0; i < 8;) {
    Loop loop = oracle::random_stable_loop(random);
    loop.family.prefilter = Prefilter::none, loop.setting.b = loop.setting.c = 0;
    if (loop.family.n == 0 && loop.setting.delta > 0) continue;
    ++i;
    SCOPED_TRACE(simulate_command(loop));
    const Response r = simulate(loop, Horizon::until_settled(), {}, kAllSteps);
    if (r.horizon > 500) continue;
    const Noise noise{.kind = gaussian, .amplitude = 1, .sampling = 0.02, .seed = 5};
    const NoiseAnswer answer(r, noise.sampling, 20 * r.horizon);
    const std::vector<double> u = answer.u(noise);
    const auto settled = static_cast<std::size_t>(r.horizon / noise.sampling);
    double square = 0, variation = 0;
    for (std::size_t k = settled; k < u.size(); ++k) square += u[k] * u[k], variation += std::abs(u[k] - u[k - 1]);
    const auto count = static_cast<double>(u.size() - settled);
    EXPECT_NEAR(std::sqrt(square / count), answer.u_sigma_ratio(), 0.1 * answer.u_sigma_ratio());
    EXPECT_NEAR(variation / count, std::sqrt(2 / std::numbers::pi) * answer.u_increment_ratio(),
                0.05 * answer.u_increment_ratio());
  }
}

/// From the response to one held value, against the frequency integral.
TEST(NoiseGainOverTime, IsThatOfTheFrequencies) {
  oracle::Random random(421);
  for (int i = 0; i < 15;) {
    Loop loop = oracle::random_stable_loop(random);
    if (loop.family.n == 0 && loop.setting.delta > 0) continue;
    ++i;
    const double sampling = random.log_uniform(0.01, 3), expected = portrait::noise_gain(loop, sampling);
    const Response r = simulate(loop, Horizon::until_settled(), {}, kAllSteps);
    EXPECT_NEAR(noise_gain(r, sampling), expected, 1e-7 * expected) << simulate_command(loop);
  }
}

// ---------------------------------------------------------------------------------------------- the papers

/// Integral of |y| by the trapezoidal rule over the instants, as the papers' programs take it.
double sampled_iae(const std::vector<double>& y, double sampling) {
  double sum = 0;
  for (std::size_t k = 1; k < y.size(); ++k) sum += 0.5 * sampling * (std::abs(y[k - 1]) + std::abs(y[k]));
  return sum;
}

/// Dalen2018 Table 6: a PI controller sampled at 0.1 with Euler's integral, steps of the output at 0 and of the input at 50. The
/// digits of the table, which a continuous controller does not give.
TEST(PublishedDalen2018, Table6SampledAsInThePaper) {
  struct Row {
    double Kp, Ti, IAE_vy, IAE_vu, TV;
  };
  for (const Row& row :
       {Row{0.406937, 6.143464, 4.3953, 15.2639, 3.3285}, Row{0.446429, 8.96, 4.2368, 20.0600, 3.1151}}) {
    const GeneralLoop loop{{{{1}, {{0, 1}}}, 1}, pid_controller({.Kp = row.Kp, .Ki = row.Kp / row.Ti, .Kd = 0})};
    const Sampled o = simulate_sampled(loop, kOutputStep, 0.1, 50, std::nullopt);
    const Sampled d = simulate_sampled(loop, kDisturbance, 0.1, 50, std::nullopt);
    double TV = 1;
    for (std::size_t k = 1; k < o.u.size(); ++k)
      TV += std::abs(o.u[k] - o.u[k - 1]) + std::abs(d.u[k] - d.u[k - 1]);
    EXPECT_NEAR(sampled_iae(o.y, 0.1), row.IAE_vy, 5e-3);
    EXPECT_NEAR(sampled_iae(d.y, 0.1), row.IAE_vu, 5e-3);
    EXPECT_NEAR(TV, row.TV, 5e-3);
  }
}

/// Huba2022: the controllers of Table 2 for a dead time of 1.1, in a loop with dead time 1 and Tf = 0.1, prefilter (24).
GeneralLoop table_2(double kappa, double tau_i, double delta, double b) {
  constexpr double kTd = 1.1;
  const double Kp = kappa / (kTd * kTd), Ti = tau_i * kTd, Kd = delta / kTd;
  GeneralLoop loop{{{{1}, {{0, 1}, {0, 1}}}, 1}, pid_controller({.Kp = Kp, .Ki = Kp / Ti, .Kd = Kd}, 1, 0.1)};
  loop.controller.prefilter = transfer_function({1, b}, {1, Ti, Ti * Kd / Kp});
  return loop;
}

/// TV2(u_w) of Table 6, to what the seed leaves open: over 50,000 samples some 0.3 %.
TEST(PublishedHuba2022, Table6UnderNoise) {
  struct Row {
    double T_o, kappa, tau_i, delta, TV2;
  };
  for (const Row& row :
       {Row{2.4051, 0.1248, 10.324, 0.5045, 1529.2}, Row{1.7750, 0.1148, 11.354, 0.4926, 1493.4},
        Row{1.5446, 0.1013, 13.063, 0.4768, 1445.4}, Row{1.4225, 0.08978, 14.932, 0.4636, 1405.2}}) {
    const GeneralLoop loop = table_2(row.kappa, row.tau_i, row.delta, row.T_o);
    const Response r = simulate(loop, Horizon::until_settled(), {}, kAllSteps);
    const NoiseAnswer answer(r, 0.001, 50);
    const NoisyMeasures m =
        noisy_measures(r.steps[kSetpoint], answer, {.amplitude = 0.01, .sampling = 0.001, .seed = 1});
    EXPECT_NEAR(m.TVm_u[2], row.TV2, 5e-3 * row.TV2);
  }
}

/// (42): the PD controller of the triple pole, whose value fits 20,000 samples.
TEST(PublishedHuba2022, PdUnderNoise) {
  constexpr double kTd = 1.1;
  const GeneralLoop loop{{{{1}, {{0, 1}, {0, 1}}}, 1},
                         pid_controller({.Kp = 0.0790 / (kTd * kTd), .Ki = 0, .Kd = 0.4612 / kTd}, 1, 0.1)};
  const Response r = simulate(loop, Horizon::until_settled(), {}, kAllSteps);
  const NoisyMeasures m = noisy_measures(r.steps[kSetpoint], NoiseAnswer(r, 0.001, 20),
                                         {.amplitude = 0.01, .sampling = 0.001, .seed = 1});
  EXPECT_NEAR(m.TVm_u[2], 560.31, 5.6);
}

/// sigma_rel of Tables 3 to 5, as simulated there, of white noise held over 0.002: within 4 % of the exact values.
TEST(PublishedHoPid, SigmaRel) {
  struct Case {
    std::vector<double> gains;
    int n;
    double Tf, published;
  };
  const GeneralPlant P3{multiple_lag(1, 1, 3), 0.5};
  for (const Case& c : {Case{{0.678769, 2.444149, 3.281553, 1.954522, 0.440372}, 4, 0.209371, 1.85},
                        Case{{0.844072, 2.872892, 3.561959, 1.884458, 0.351957}, 4, 0.123995, 9.2},
                        Case{{0.617562, 2.399279, 3.548018, 2.392156, 0.631583}, 3, 0.398239, 10.1},
                        Case{{0.742409, 2.563469, 3.246569, 1.776507, 0.351919}, 6, 0.104398, 3.33},
                        Case{{0.516502, 1.323396, 0.904344}, 2, 0.015141, 10.9},
                        Case{{0.874960, 3.266726, 4.692241, 3.227079, 1.069913, 0.143378}, 5, 0.161006, 8.9}}) {
    const NormalisedLoop inside = normalised({P3, gains_controller(c.gains, c.n, c.Tf)});
    const Response r = simulate(inside.loop, Horizon::until_settled(), {}, kAllSteps);
    const NoiseAnswer answer(r, 0.002 / inside.units.time, 40 / inside.units.time);
    EXPECT_NEAR(answer.u_sigma_ratio(), c.published, 0.04 * c.published);
  }
}

}  // namespace
}  // namespace portrait::reference
