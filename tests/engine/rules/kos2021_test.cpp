/// Ten-digit targets, made once with mpmath from the three magnitude-optimum conditions themselves (2.4).

#include <cmath>

#include <gtest/gtest.h>

#include "engine/rules/integrating_magnitude_optimum.h"

namespace portrait::rules {
namespace {

struct Case {
  Polynomial N, D;
  double Td, b;
  double pi_Kp, pi_Ki, Kp, Ki, Kd;  ///< PID with Tf = 0.01
};

const std::vector<Case>& cases() {
  static const Polynomial four = {1, 4, 6, 4, 1};
  static const std::vector<Case> all = {
      {{1}, {1}, 1, 0, 0.5857864376, 0.1715728753, 1.127957687, 0.4749416804, 0.3394155492},
      {{1}, {1}, 1, 0.5, 0.5584815599, 0.1169631198, 1.001665221, 0.3258173358, 0.309576036},
      {{1}, {1, 2, 1}, 0.2, 0, 0.2469547881, 0.03049333368, 0.9301074514, 0.2332723498, 0.8542700662},
      {{1}, {1, 2, 1}, 1, 0.5, 0.1809995297, 0.01228531115, 0.4633576663, 0.06299161507, 0.5562965006},
      {{1}, four, 0, 0.5, 0.1352966685, 0.006864445694, 0.3454110035, 0.03499078726, 0.5572894462},
      {{1, -2}, {1, 2, 1}, 0, 0, 0.1504720765, 0.01132092291, 0.3313257284, 0.03934869594, 0.3949221912},
      {{1}, {1, 1}, 0.05, 0.5, 0.4804149128, 0.08654943317, 51.21216436, 171.2948101, 9.483210337},
  };
  return all;
}

TEST(IntegratingMagnitudeOptimum, MeetsTheTargets) {
  for (const Case& c : cases()) {
    const Areas A = areas_of(c.N, c.D, c.Td, 5);
    const auto pi = integrating_pi(A, c.b);
    EXPECT_NEAR(pi->Kp, c.pi_Kp, 1e-10);
    EXPECT_NEAR(pi->Ki, c.pi_Ki, 1e-10);
    const auto pid = integrating_pid(filtered(A, 0.01, 1), c.b);
    EXPECT_NEAR(pid->Kp / c.Kp, 1, 2e-9);
    EXPECT_NEAR(pid->Ki / c.Ki, 1, 2e-9);
    EXPECT_NEAR(pid->Kd / c.Kd, 1, 2e-9);
  }
}

TEST(IntegratingMagnitudeOptimum, ScalesWithGainTimeAndSign) {
  const Areas A = areas_of(Polynomial{1}, {1, 2, 1}, 0.2, 5);
  Areas scaled = A;
  constexpr double kGain = -8.5, kTime = 1e-3;
  double T = 1;
  for (double& a : scaled) a *= kGain * T, T *= kTime;
  const auto plain = integrating_pid(A, 0.5), changed = integrating_pid(scaled, 0.5);
  EXPECT_NEAR(changed->Kp * kGain * kTime, plain->Kp, 1e-12);
  EXPECT_NEAR(changed->Ki * kGain * kTime * kTime, plain->Ki, 1e-12);
  EXPECT_NEAR(changed->Kd * kGain, plain->Kd, 1e-12);
  EXPECT_NEAR(integrating_pi(scaled, 0.5)->Kp * kGain * kTime, integrating_pi(A, 0.5)->Kp, 1e-12);
}

TEST(IntegratingMagnitudeOptimum, SpeedOneChangesNothing) {
  const Areas A = areas_of(Polynomial{1}, {1, 2, 1}, 0.2, 5);
  const auto pid = integrating_pid(A, 0.5);
  const auto same = integrating_pid_of_speed(A, 0.5, residence_time(A, *pid, 0.5));
  EXPECT_NEAR(same->Kp, pid->Kp, 1e-12);
  EXPECT_NEAR(same->Kd, pid->Kd, 1e-12);
  EXPECT_EQ(integrating_pid_of_speed(A, 0.5, slowest_pid(A, 0.5) * 1.001)->Kd, 0);
  const auto pd = integrating_pd(A);
  const auto same_pd = integrating_pid_of_speed(A, 1, residence_time(A, *pd, 1));
  EXPECT_NEAR(same_pd->Kp, pd->Kp, 1e-12);
  EXPECT_NEAR(same_pd->Kd, pd->Kd, 1e-12);
}

/// The reference filter (5.30) makes the setpoint response agree with that of the PD loop in two more coefficients.
TEST(IntegratingMagnitudeOptimum, SecondOrderReferenceFilterMatchesThePd) {
  const Areas A = areas_of(Polynomial{1}, {1, 1.2, 0.2}, 0.2, 5);
  const auto pid = integrating_pid(A, 0), pd = integrating_pd(A);
  const auto [b1, b2] = reference_filter_2(A, *pid, *pd);
  const auto G = [&](double s) {
    double sum = 0;
    for (std::size_t i = 5; i-- > 0;) sum = sum * -s + A[i];
    return sum / s;
  };
  const auto difference = [&, b1 = b1, b2 = b2](double s) {
    const double C = pid->Ki + pid->Kp * s + pid->Kd * s * s, H = (pd->Kp + pd->Kd * s) * G(s);
    const double F = (1 + b1 * s + b2 * s * s) / (1 + pid->Kp / pid->Ki * s + pid->Kd / pid->Ki * s * s);
    return std::abs(F * C * G(s) / (s + C * G(s)) - H / (1 + H));
  };
  EXPECT_NEAR(std::log2(difference(0.02) / difference(0.01)), 3, 0.2);
}

TEST(IntegratingMagnitudeOptimum, AnOscillatingPlantHasNoPi) {
  EXPECT_FALSE(integrating_pi({1, 1, -3}, 0).has_value());
  EXPECT_TRUE(integrating_pi({1, 1, -3}, 0.9).has_value());
}

}  // namespace
}  // namespace portrait::rules
