/// General loops against published values: Dalen2018, the HO-PID paper, Huba2021. Digits are compared as printed.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "engine/loop/general_loop.h"
#include "engine/reference/measure.h"
#include "tests/oracle/quadrature.h"

namespace portrait::reference {
namespace {

using enum Measure;

// ---------------------------------------------------------------------------------------------- Dalen2018

struct Row {
  double Kp, Ti;
  double IAE_vy, IAE_vu, TV, GM, PM, DM;  ///< Ms is 1.59 in all
};

MeasureRow of_pi(const GeneralPlant& plant, double Kp, double Ti) {
  const GeneralLoop loop{plant, pid_controller({.Kp = Kp, .Ki = Kp / Ti, .Kd = 0})};
  const MeasuredInUnits found = measure_in_units(loop, Horizon::until_settled(), kAllSteps);
  EXPECT_EQ(found.measured.status, Status::settled);
  return found.measured.measures;
}

/// The tables' TV is that of u + v over both experiments, without the kick at t = 0.
void expect_row(const GeneralPlant& plant, const Row& row, double iae_tolerance, double tv_tolerance) {
  SCOPED_TRACE(row.Kp);
  const MeasureRow m = of_pi(plant, row.Kp, row.Ti);
  EXPECT_NEAR(m[Ms], 1.59, 0.006);
  EXPECT_NEAR(m[GM], row.GM, 0.012);
  EXPECT_NEAR(m[PM], row.PM, 0.015);
  EXPECT_NEAR(m[DM], row.DM, 0.006);
  EXPECT_NEAR(m[IAE_o], row.IAE_vy, iae_tolerance);
  EXPECT_NEAR(m[IAE_d], row.IAE_vu, iae_tolerance);
  EXPECT_NEAR(m[TV_uo] - std::abs(row.Kp) + m[TV_ud] + 1, row.TV, tv_tolerance);
}

/// Settings unrounded, as the rules give them for the printed choices. Table 6 was sampled at 0.1, which moves IAE_vy by 0.05 and
/// TV by 0.05: noise_test.cpp has it to the digit.
TEST(PublishedDalen2018, Table6) {
  const GeneralPlant iptd{{{1}, {{0, 1}}}, 1};
  expect_row(iptd, {0.406937, 6.143464, 4.39, 15.26, 3.33, 3.56, 44.57, 1.79}, 0.06, 0.05);
  expect_row(iptd, {0.446429, 8.96, 4.24, 20.06, 3.12, 3.34, 50.02, 1.90}, 0.06, 0.05);
}

/// The printed IAE of Table 8 are split at t = 150 where the step is at 140; the true ones stand in their place.
TEST(PublishedDalen2018, Table8) {
  const GeneralPlant heater{multiple_lag(5.7, 60, 1), 4};
  expect_row(heater, {1.167098, 22.548055, 13.4996, 19.3198, 3.94, 3.36, 50.49, 7.51}, 0.001, 0.015);
  expect_row(heater, {1.253133, 33.6, 11.9503, 26.8128, 3.70, 3.22, 56.21, 8.08}, 0.001, 0.015);
}

/// delta = 1.63195 gives the Ms asked for; with the printed 1.63 GM is 6.7373.
TEST(PublishedDalen2018, Table10) {
  const GeneralPlant column{transfer_function({34}, {1, 55, 54.25, 13.5}), 0};
  const double a = 1.135353, k = 0.597, tau = 0.923, delta = 1.63195;
  expect_row(column,
             {a / (k * tau * (delta + 1)), 2.5 / a * (delta + 1) * tau, 3.62, 6.83, 3.77, 6.74, 43.63, 1.54}, 0.01,
             0.01);
  expect_row(column, {54.25 / (34 * (1.0085 + 0.75)), 4 * (1.0085 + 0.75), 3.35, 7.74, 3.77, 6.13, 46.74, 1.49},
             0.03, 0.015);
}

TEST(PublishedDalen2018, Tables12And14) {
  const GeneralPlant submersible{
      {scaled(-2.6158, {1, 2.299}), {{1, 0.8131}, {1, 0.5}, {1, 1.738 * 7.692, 7.692 * 7.692}}}, 0};
  // Ms = 1.59 needs delta = 2.198797, of which the table prints 2.20.
  const double a = 1.135353, k = -0.145, tau = 1.729, delta = 2.198797;
  expect_row(submersible,
             {a / (k * tau * (delta + 1)), 2.5 / a * (delta + 1) * tau, 6.41, 8.59, 4.62, 13.80, 43.90, 3.03},
             0.025, 0.02);
  expect_row(submersible,
             {1.165295 / (k * 0.74 * tau * 3.7), 2.7 / 1.165295 * 3.7 * tau, 5.88, 8.69, 5.06, 11.85, 44.15, 2.74},
             0.05, 0.02);
}

/// Without sign change IAE is the integral of the error, Ti/Kp.
TEST(PublishedDalen2018, SimcOnAnIntegratorIsExact) {
  EXPECT_NEAR(of_pi({{{1}, {{0, 1}}}, 1}, 0.5, 8)[IAE_d], 16, 1e-8);
}

// ---------------------------------------------------------------------------------------------- HO-PID

GeneralLoop by_gains(const GeneralPlant& plant, const std::vector<double>& gains, int n, double Tf) {
  return {plant, gains_controller(gains, n, Tf)};
}

/// Table 6, and 7.3: Ms with the filter.
TEST(PublishedHoPid, Ms) {
  struct Case {
    GeneralPlant plant;
    std::vector<double> gains;
    double Tf, Ms;
  };
  const GeneralPlant P4{multiple_lag(1, 1, 3), 1}, P1{multiple_lag(1, 1, 4), 0};
  for (const Case& c :
       {Case{P4, {0.498031, 1.597005, 1.751895, 0.668023}, 0.070198, 1.77582},
        Case{P4, {0.553704, 1.991713, 2.673756, 1.595919, 0.362244}, 0.125019, 1.85742},
        Case{P4, {0.578561, 2.307097, 3.628538, 2.833035, 1.117634, 0.184923}, 0.170372, 1.90677}}) {
    const int n = static_cast<int>(c.gains.size()) - 1;
    EXPECT_NEAR(measure_in_units(by_gains(c.plant, c.gains, n, c.Tf), Horizon::fixed(1)).measured.measures[Ms],
                c.Ms, 5e-5);
  }
  const auto of_P1 = [&](const std::vector<double>& gains) {
    const int n = static_cast<int>(gains.size()) - 2;
    return measure_in_units(by_gains(P1, gains, n, 0.1), Horizon::fixed(1)).measured.measures[Ms];
  };
  EXPECT_NEAR(of_P1({0.437778, 1.294890, 1.041102}), 1.54740, 5e-5);
  EXPECT_NEAR(of_P1({0.812197, 2.911227, 3.599028, 1.556373}), 1.47537, 5e-5);
  EXPECT_NEAR(of_P1({1.809742, 7.281891, 11.008066, 7.417095, 1.882806}), 1.49421, 5e-5);
}

/// int (r_f - y)^2 dt, r_f = 1 - (1 + t/T) e^{-t/T}: the tables' tracking ISE, of the filtered setpoint.
double tracking_ise(const GeneralLoop& loop, double T) {
  static const oracle::GaussRule rule = oracle::gauss_rule(16);
  const NormalisedLoop inside = normalised(loop);
  const Response r = simulate(inside.loop, Horizon::until_settled());
  double sum = 0;
  for (const Piece& piece : r.steps[kSetpoint].pieces)
    sum += oracle::integral(rule, piece.start, piece.start + piece.length, [&](double t) {
      const double x = t * inside.units.time / T, e = 1 - (1 + x) * std::exp(-x) - y_at(r.steps[kSetpoint], t);
      return e * e;
    });
  return sum * inside.units.time;
}

/// Tables 7, 8 and 9. Table 7 prints Table 8's disturbance values for G_P5: 4.38e-7 and 1.95e-7.
TEST(PublishedHoPid, Ise) {
  struct Case {
    TransferFunction plant;
    std::vector<double> gains;
    double Tf, tracking, disturbance;
  };
  const TransferFunction P5{{1}, {{1, 1}, {1, 0.5}, {1, 1 / 3.0}}},
      P6{{1 / 18.0}, {{1, 1}, {1, 1 / 3.0}, {1, 1 / 6.0}}};
  for (const Case& c : {Case{P5, {25.06, 45.95, 25.07, 4.18}, 0.01, 0.0228, 4.78e-4},
                        Case{P5, {37.5262, 69.4238, 38.6735, 6.8801, 0.10430}, 0.01, 0.0131, 2.13e-4},
                        Case{P5, {2.20, 3.60, 1.60, 0.06}, 0.01, 0.322, 0.0615},
                        Case{P6, {902, 1353, 501, 50.1}, 0.005, 8.12e-3, 4.39e-7},
                        Case{P6, {1350.774, 2037.423, 767.323, 81.299, 0.6256}, 0.005, 4.11e-3, 1.957e-7},
                        Case{P6, {529.8, 516.5, 179.2, 26.3}, 0.005, 1.97e-2, 2.18e-6}}) {
    SCOPED_TRACE(c.tracking);
    const int n = static_cast<int>(c.gains.size()) - 2;
    GeneralLoop loop = by_gains({c.plant, 0}, c.gains, n, c.Tf);
    loop.controller.prefilter = multiple_lag(1, 0.01, 2);
    EXPECT_NEAR(tracking_ise(loop, 0.01), c.tracking, 5e-3 * c.tracking);
    EXPECT_NEAR(measure_in_units(loop, Horizon::until_settled()).measured.measures[ISE_d], c.disturbance,
                3e-3 * c.disturbance);
  }
}

// ---------------------------------------------------------------------------------------------- Huba2021

/// (14), (15); without the second-order terms (11), (12): on a plant of time constant T1 and dead time Td, with the gain of
/// a plant of time constant T_gain.
GeneralController model_based(double T_gain, double T1, double Td, double Tc, double second, double Tf) {
  const double Kc = T_gain / (Tc + Td), share = Tc / (Tc + Td);
  const Polynomial lead{1, Td / 2, second * Td * Td}, lag{1, share * Td / 2, share * second * Td * Td};
  const Polynomial N = portrait::product(scaled(Kc / T1, {1, T1}), trimmed(lead));
  return controller({N, {trimmed(lag), {1, Tf}, {1, Tf}, {0, 1}}});
}

/// Example 1, disturbance step: IAE is 1.978 under PID with Tf = 0.1, Tc = 0.7, and 1.896 under PIDA with Tf = 0.15, Tc = 0.5,
/// beside 1.98 and 1.897 by (49). But (49) with these numbers is K(Tc + Td) = 1.8 and 1.65, and so are the loops of (81): the
/// published values are those of Kc with the identified T1m = 1 and of Ti = T1 = 1.1 and 1.15, Ti/Kc = 1.98 and 1.8975.
TEST(PublishedHuba2021, Example1) {
  const GeneralPlant fotd{multiple_lag(1, 1, 1), 1};
  const auto iae = [&](double T_gain, double Tf, double Tc, double second) {
    const GeneralLoop loop{fotd, model_based(T_gain, 1 + Tf, 1 + Tf, Tc, second, Tf)};
    return measure_in_units(loop, Horizon::fixed(12)).measured.measures[IAE_d];
  };
  EXPECT_NEAR(iae(1, 0.1, 0.7, 0), 1.978, 5e-4);
  EXPECT_NEAR(iae(1, 0.15, 0.5, 1 / 12.0), 1.896, 5e-4);
  EXPECT_NEAR(iae(1.1, 0.1, 0.7, 0), 1.8, 2e-3) << "as (7) and (81) say";
  EXPECT_NEAR(iae(1.15, 0.15, 0.5, 1 / 12.0), 1.65, 2e-3) << "as (7) and (81) say";
}

}  // namespace
}  // namespace portrait::reference
