#include "engine/rules/pareto_pi.h"

#include <array>
#include <cmath>

#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"
#include "engine/rules/root.h"
#include "engine/sweep/method.h"

namespace portrait::rules {
namespace {

using Objective = std::function<double(double log_cbar)>;

constexpr double kLeastCbar = 0.5, kMostCbar = 200;

/// Of the loops along a curve of constant cbar, Kp falling as x = delta + 1 rises.
StandardForm on_curve(const PiLoop& loop, double cbar, double x) {
  if (std::isinf(cbar)) return {.Kc = 1 / (loop.scale.k * loop.scale.tau * x), .Ti = kInf, .TD = 0};
  const StandardForm form = delta_tuning_by_margin(loop.scale, cbar, (x - 1) * loop.scale.tau);
  return {.Kc = form.Kc, .Ti = form.Ti, .TD = 0};
}

double sensitivity(const PiLoop& loop, double cbar, double x) {
  const StandardForm form = on_curve(loop, cbar, x);
  return loop.Ms(form.Kc, form.Ti);
}

/// Fourth-order difference quotient.
double slope(const Objective& f, double x) {
  constexpr double h = 0.01;
  return (f(x - 2 * h) - 8 * f(x - h) + 8 * f(x + h) - f(x + 2 * h)) / (12 * h);
}

/// Least of f over log cbar: a scan, then the zero of the slope between the neighbours of the least point.
double minimum_at(const Objective& f) {
  constexpr int kPoints = 24;
  const double first = std::log(kLeastCbar), step = (std::log(kMostCbar) - first) / kPoints;
  int best = -1;
  double least = kInf;
  for (int i = 0; i <= kPoints; ++i)
    if (const double J = f(first + i * step); J < least) least = J, best = i;
  if (best <= 0 || best >= kPoints) return first + std::max(best, 0) * step;
  return root_between([&](double x) { return slope(f, x); }, first + (best - 1) * step, first + (best + 1) * step,
                      1e-9);
}

/// The normalised loop with this PI: kappa and tau_i from Kp and Ti.
Loop normalised_pi(Plant plant, double gain, double tau, double tau_1, double Kp, double Ti) {
  Loop loop;
  loop.family = {.plant = plant, .n = 0, .prefilter = Prefilter::none};
  loop.setting = {.kappa = Kp * gain, .tau_i = Ti / tau, .delta = 0, .tau_1 = tau_1};
  return loop;
}

double peak(const Loop& loop) {
  const OpenLoop open = open_loop(loop);
  return is_stable(open) ? sensitivity_peak(open).value : kInf;
}

/// In real units: a setpoint step's error scales with time, a disturbance's with time and the plant's gain.
PiErrors errors(const Loop& loop, double gain, double tau) {
  SettingMeasured measured;
  measure_settings(Method::kernel, loop.family, Horizon::until_settled(), {}, {&loop.setting, 1}, {&measured, 1});
  return {measured.measures[Measure::IAE_w] * tau, measured.measures[Measure::IAE_d] * tau * std::abs(gain)};
}

PiLoop normalised_loop(Plant plant, double gain, double tau, double tau_1, const IntegratingPlant& scale) {
  const auto at = [=](double Kp, double Ti) { return normalised_pi(plant, gain, tau, tau_1, Kp, Ti); };
  return {.Ms = [=](double Kp, double Ti) { return peak(at(Kp, Ti)); },
          .errors = [=](double Kp, double Ti) { return errors(at(Kp, Ti), gain, tau); },
          .scale = scale,
          .integrating = plant == Plant::ipdt};
}

}  // namespace

PiLoop pi_loop(const IntegratingPlant& p) { return normalised_loop(Plant::ipdt, p.k * p.tau, p.tau, 0, p); }
PiLoop pi_loop(const LagDelayPlant& p) {
  return normalised_loop(Plant::fotd, p.K, p.tau, p.T / p.tau, {p.K / p.T, p.tau});
}

std::optional<StandardForm> pi_of_sensitivity(const PiLoop& loop, double cbar, double Ms) {
  constexpr double kSlowest = 1e3, kFastest = 1e-3, kStep = 1.25;
  double slow = kSlowest;
  if (!(sensitivity(loop, cbar, slow) < Ms)) return std::nullopt;
  while (slow / kStep > kFastest && sensitivity(loop, cbar, slow / kStep) < Ms) slow /= kStep;
  const auto excess = [&](double x) { return sensitivity(loop, cbar, x) - Ms; };
  return on_curve(loop, cbar, root_between(excess, slow / kStep, slow, 1e-14));
}

namespace {

PiErrors errors_on_curve(const PiLoop& loop, double log_cbar, double Ms) {
  const auto form = pi_of_sensitivity(loop, std::exp(log_cbar), Ms);
  return form ? loop.errors(form->Kc, form->Ti) : PiErrors{kNaN, kNaN};
}

/// The least values of both at this Ms, each for itself.
PiErrors least_errors(const PiLoop& loop, double Ms) {
  const auto least = [&](double PiErrors::*of) {
    const double at = minimum_at([&](double x) { return errors_on_curve(loop, x, Ms).*of; });
    return errors_on_curve(loop, at, Ms).*of;
  };
  PiErrors found{kNaN, least(&PiErrors::IAE_vu)};
  if (!loop.integrating) {
    found.IAE_vy = least(&PiErrors::IAE_vy);
  } else if (const auto p = pi_of_sensitivity(loop, kInf, Ms)) {
    found.IAE_vy = loop.errors(p->Kc, p->Ti).IAE_vy;
  }
  return found;
}

}  // namespace

std::optional<ParetoPi> pareto_pi(const PiLoop& loop, double Ms, double s_r) {
  return pareto_pi(loop, Ms, s_r, least_errors(loop, Ms));
}

std::optional<ParetoPi> pareto_pi(const PiLoop& loop, double Ms, double s_r, const PiErrors& reference) {
  const auto J = [&](const PiErrors& e) {
    return s_r * e.IAE_vy / reference.IAE_vy + (1 - s_r) * e.IAE_vu / reference.IAE_vu;
  };
  const double at = minimum_at([&](double x) { return J(errors_on_curve(loop, x, Ms)); });
  const auto form = pi_of_sensitivity(loop, std::exp(at), Ms);
  if (!form || std::isnan(reference.IAE_vy) || std::isnan(reference.IAE_vu)) return std::nullopt;
  const PiErrors found = loop.errors(form->Kc, form->Ti);
  return ParetoPi{form->Kc, form->Ti, std::exp(at), J(found), found, reference};
}

}  // namespace portrait::rules
