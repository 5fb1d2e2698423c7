/// Records of plants whose answer is known in closed form, against areas computed from the plant.

#include "engine/records/record_areas.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/loop/loop.h"
#include "engine/rules/areas.h"

namespace portrait::records {
namespace {

/// Of 1/(1 + s)^2.
double two_lags(double t) { return t > 0 ? 1 - (1 + t) * std::exp(-t) : 0; }

/// A step at 3.003, between the samples of 0.01, as a converter makes it: the input is seen from 3.01 on and acts from there.
Record recorded(const std::function<double(double)>& step_answer, const std::function<double(double)>& u,
                double end, const std::vector<std::pair<double, double>>& steps) {
  Record r;
  for (int i = 0; 0.01 * i <= end; ++i) {
    const double t = 0.01 * i;
    double y = 2;
    for (const auto& [at, size] : steps) y += size * step_answer(t - at);
    r.t.push_back(t), r.u.push_back(u(t)), r.y.push_back(y);
  }
  return r;
}

double step_at_3(double t) { return t >= 3 - 1e-9 ? 1.5 : 0.5; }
/// To 3 at 3, to 1 at 5.
double pulse_and_step(double t) { return t >= 5 - 1e-9 ? 1 : t >= 3 - 1e-9 ? 3 : 0; }

void expect_areas(const std::vector<double>& found, const std::vector<double>& plant, double tolerance) {
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / plant[i], 1, tolerance) << i;
}

TEST(RecordAreas, SelfRegulatingFromAStepAndFromAPulseWithAStep) {
  const auto answer = [](double t) { return two_lags(t - 0.5); };
  const std::vector<double> exact = rules::areas_of(Polynomial{1}, {1, 2, 1}, 0.5, 6);
  const Record step = recorded(answer, step_at_3, 45, {{3, 1}});
  expect_areas(self_regulating_areas(step, 6, kNaN).areas, exact, 3e-5);
  const Record pulse = recorded(answer, pulse_and_step, 45, {{3, 3}, {5, -2}});
  expect_areas(self_regulating_areas(pulse, 6, kNaN).areas, exact, 2e-4);
}

TEST(RecordAreas, ErrorFallsWithTheSquareOfTheSampling) {
  const std::vector<double> exact = rules::areas_of(Polynomial{1}, {1, 2, 1}, 0.5, 4);
  const Record fine = recorded([](double t) { return two_lags(t - 0.5); }, step_at_3, 45, {{3, 1}});
  Record coarse;
  for (std::size_t i = 0; i < fine.size(); i += 10)
    coarse.t.push_back(fine.t[i]), coarse.u.push_back(fine.u[i]), coarse.y.push_back(fine.y[i]);
  const double few = self_regulating_areas(coarse, 4, kNaN).areas[3] - exact[3];
  const double many = self_regulating_areas(fine, 4, kNaN).areas[3] - exact[3];
  EXPECT_NEAR(few / many, 100, 15);
}

TEST(RecordAreas, IntegratingWithDriftAndOffset) {
  // e^{-s}/(s (1 + s)^2): the answer of (6.5), on a drift.
  const auto answer = [](double t) {
    const double x = std::max(t - 1, 0.0);
    return x - 2 + (2 + x) * std::exp(-x);
  };
  Record r = recorded(answer, step_at_3, 60, {{3, 1}});
  for (std::size_t i = 0; i < r.size(); ++i) r.y[i] += 0.25 * r.t[i];
  const RecordAreas found = integrating_areas(r, 5, kNaN);
  EXPECT_NEAR(found.quality.drift, 0.25, 1e-12);
  expect_areas(found.areas, rules::areas_of(Polynomial{1}, {1, 2, 1}, 1, 5), 3e-5);
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(RecordAreas, WhatHasNotSettledOrNotChangedIsRefused) {
  const auto answer = [](double t) { return two_lags(t / 10); };
  const Record unsettled = recorded(answer, step_at_3, 25, {{3, 1}});
  EXPECT_TRUE(error_of([&] {
                self_regulating_areas(unsettled, 4, kNaN);
              }).starts_with("y has not come to rest at the end of the record"));
  const auto back = [](double t) { return t >= 3 && t < 4 ? 1.0 : 0.0; };
  const Record pulse = recorded([](double t) { return two_lags(t); }, back, 45, {{3, 1}, {4, -1}});
  EXPECT_TRUE(error_of([&] { self_regulating_areas(pulse, 4, kNaN); }).starts_with("u must end on a new level"));
  EXPECT_TRUE(error_of([&] { self_regulating_areas(unsettled, 4, 24.99); }).starts_with("the settled part"));
}

}  // namespace
}  // namespace portrait::records
