#include "engine/loop/general_loop.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/words.h"

namespace portrait {
namespace {

/// Two roots closer than this part of their size are one: what coefficients of 16 digits can tell of a double root.
constexpr double kSameRoot = 1e-6;

std::vector<std::complex<double>> roots(const std::vector<Polynomial>& factors) {
  std::vector<std::complex<double>> all;
  for (const Polynomial& p : factors)
    for (const std::complex<double>& root : complex_roots(p)) all.push_back(root);
  return all;
}

bool is_unstable(std::complex<double> root) { return root.real() > kSameRoot * std::abs(root); }

/// A root of N in the right half-plane that is one of D too.
std::optional<std::complex<double>> common_unstable_root(const Polynomial& N, const std::vector<Polynomial>& D) {
  const auto of_D = roots(D);
  for (const std::complex<double>& zero : roots({N}))
    for (const std::complex<double>& pole : of_D)
      if (is_unstable(pole) && std::abs(zero - pole) < kSameRoot * std::abs(pole)) return pole;
  return std::nullopt;
}

bool has_root_at_0(const Polynomial& p) { return degree(p) >= 1 && p[0] == 0; }
bool has_root_at_0(const std::vector<Polynomial>& factors) {
  return std::any_of(factors.begin(), factors.end(), [](const Polynomial& p) { return has_root_at_0(p); });
}

std::string place(std::complex<double> s) {
  if (s.imag() == 0) return fmt::format("s = {:.6g}", s.real());
  return fmt::format("s = {:.6g} +- {:.6g}j", s.real(), std::abs(s.imag()));
}

std::optional<std::string> why_hidden(const char* zeros_of, const Polynomial& N, const char* poles_of,
                                      const std::vector<Polynomial>& D) {
  if (has_root_at_0(N) && has_root_at_0(D))
    return fmt::format("a zero of the {} at s = 0 cancels an integrator of the {}: what it holds never settles",
                       zeros_of, poles_of);
  if (const auto pole = common_unstable_root(N, D))
    return fmt::format("a zero of the {} cancels an unstable pole of the {} at {}: the loop is unstable inside",
                       zeros_of, poles_of, place(*pole));
  return std::nullopt;
}

std::optional<std::string> why_plant_invalid(const GeneralPlant& plant) {
  if (const auto reason = why_invalid(plant.rational)) return "plant: " + *reason;
  if (degree(plant.rational.numerator) < 0) return "the plant is 0";
  if (relative_degree(plant.rational) < 0)
    return fmt::format("the plant is improper: its numerator has degree {}, its denominator {}",
                       degree(plant.rational.numerator), degree(plant.rational.denominator));
  if (!std::isfinite(plant.dead_time) || plant.dead_time < 0)
    return fmt::format("the dead time must be finite and not below 0 (it is {})", number_text(plant.dead_time));
  return std::nullopt;
}

std::optional<std::string> why_controller_invalid(const GeneralController& c) {
  if (const auto reason = why_invalid(TransferFunction{c.on_setpoint, c.denominator}))
    return "controller: " + *reason;
  if (const auto reason = why_invalid(TransferFunction{c.on_output, c.denominator}))
    return "controller: " + *reason;
  if (const auto reason = why_invalid(c.prefilter)) return "prefilter: " + *reason;
  if (degree(c.on_output) < 0) return "the controller is 0: it must answer to the output";
  const int D = degree(c.denominator);
  if (degree(c.on_setpoint) > D)
    return fmt::format("the controller is improper: degree {} over {}; a filter of higher order makes it proper",
                       degree(c.on_setpoint), D);
  if (degree(c.on_output) > D + 1)
    return fmt::format("the controller is improper: degree {} over {}; a filter of higher order makes it proper",
                       degree(c.on_output), D);
  if (relative_degree(c.prefilter) < 0) return "the prefilter is improper: a step through it is an impulse";
  for (const std::complex<double>& pole : roots(c.prefilter.denominator))
    if (!(pole.real() < 0)) return fmt::format("the prefilter has a pole at {}: it is not stable", place(pole));
  if (has_root_at_0(c.prefilter.denominator)) return "the prefilter has a pole at s = 0: it is not stable";
  return std::nullopt;
}

/// Degree of N_y P less that of D: 0 is a loop that answers at once.
int loop_excess(const GeneralLoop& loop) {
  return degree(loop.controller.on_output) - degree(loop.controller.denominator) -
         relative_degree(loop.plant.rational);
}

/// The least and the greatest time that a polynomial stands for: of 1 + a s + b s^2 + ..., |a|, sqrt(|b/a|), ...
struct Times {
  double least = kInf, greatest = 0;
  void take(double time) { least = std::min(least, time), greatest = std::max(greatest, time); }
  void take(const Polynomial& p) {
    std::optional<std::size_t> before;
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (p[k] == 0) continue;
      if (before) take(std::pow(std::abs(p[k] / p[*before]), 1 / static_cast<double>(k - *before)));
      before = k;
    }
  }
};

/// Products of all factors, squared, must stay within the range of double.
std::optional<std::string> why_too_far_apart(const GeneralLoop& loop) {
  constexpr double kMostDigits = 150, kMostOfOne = 15, kMostOfGain = 60;
  Times times;
  int orders = 0;
  double largest = 0, smallest = kInf;
  const auto take = [&](const Polynomial& p) {
    times.take(p), orders += static_cast<int>(p.size()) - 1;
    for (const double a : p)
      if (a != 0) largest = std::max(largest, std::abs(a)), smallest = std::min(smallest, std::abs(a));
  };
  for (const TransferFunction* G : {&loop.plant.rational, &loop.controller.prefilter}) {
    take(G->numerator);
    for (const Polynomial& factor : G->denominator) take(factor);
  }
  take(loop.controller.on_output), take(loop.controller.on_setpoint);
  for (const Polynomial& factor : loop.controller.denominator) take(factor);
  if (largest > std::pow(10, kMostOfGain) || smallest < std::pow(10, -kMostOfGain))
    return fmt::format("a coefficient is beyond what can be computed with: 1e-{0} to 1e{0}, or 0", kMostOfGain);
  if (loop.plant.dead_time > 0) times.take(loop.plant.dead_time);
  const double digits = times.greatest > 0 ? std::log10(times.greatest / times.least) : 0;
  if (digits <= kMostOfOne && digits * orders <= kMostDigits) return std::nullopt;
  return fmt::format("its times lie too far apart to compute with: {} to {}", number_text(times.least), number_text(times.greatest));
}

/// F(s) of the normalised families.
TransferFunction prefilter(const Loop& loop) {
  const Setting& s = loop.setting;
  const bool integral = has_integral_action(s), derivative = s.delta > 0;
  switch (loop.family.prefilter) {
    case Prefilter::none:
      return {};
    case Prefilter::pi:
      return integral ? transfer_function({1, s.b * s.tau_i}, {1, s.tau_i}) : TransferFunction{};
    case Prefilter::full:
      break;
  }
  if (!integral) return derivative ? transfer_function({1, s.b}, {1, tau_d(s)}) : TransferFunction{};
  return transfer_function({1, s.b, s.c}, {1, s.tau_i, s.tau_i * tau_d(s)});
}

}  // namespace

std::optional<std::string> why_invalid(const GeneralLoop& loop) {
  if (auto reason = why_plant_invalid(loop.plant)) return reason;
  if (auto reason = why_controller_invalid(loop.controller)) return reason;
  if (auto reason = why_too_far_apart(loop)) return reason;
  const bool derivative = degree(loop.controller.on_output) > degree(loop.controller.denominator);
  if (derivative && relative_degree(loop.plant.rational) < 1)
    return "the ideal derivative of an output that follows the input at once is an impulse; give the controller a "
           "filter";
  if (loop.plant.dead_time == 0 && loop_excess(loop) >= 0)
    return "an algebraic loop: without dead time plant and controller both answer at once; give one of them a lag, "
           "or the "
           "plant a dead time";
  const GeneralController& c = loop.controller;
  const TransferFunction& P = loop.plant.rational;
  if (auto reason = why_hidden("plant", P.numerator, "plant", P.denominator)) return reason;
  if (auto reason = why_hidden("controller", c.on_output, "controller", c.denominator)) return reason;
  if (auto reason = why_hidden("controller", c.on_output, "plant", P.denominator)) return reason;
  return why_hidden("plant", P.numerator, "controller", c.denominator);
}

GeneralLoop general(const Loop& loop) {
  const Setting& s = loop.setting;
  GeneralLoop found;
  found.plant.dead_time = 1;
  found.plant.rational.denominator.assign(static_cast<std::size_t>(integrators(loop.family.plant)), {0, 1});
  const PlantLags lags = plant_lags(loop);
  for (int i = 0; i < lags.count; ++i) found.plant.rational.denominator.push_back({1, lags.time});
  if (has_gains(loop.family)) {
    const auto gains = std::span(s.gains).first(static_cast<std::size_t>(loop.family.m) + 2);
    found.controller = gains_controller(gains, loop.family.n, s.tau_f);
    return found;
  }
  const ParallelForm form = parallel(StandardForm{.Kc = s.kappa, .Ti = s.tau_i, .TD = tau_d(s)});
  found.controller = pid_controller({form.Kp, form.Ki, s.delta}, loop.family.n, s.tau_f);
  found.controller.prefilter = prefilter(loop);
  return found;
}

OpenLoop open_loop(const GeneralLoop& loop) {
  std::vector<Polynomial> denominator = loop.plant.rational.denominator;
  denominator.insert(denominator.end(), loop.controller.denominator.begin(), loop.controller.denominator.end());
  return open_loop({loop.plant.rational.numerator, loop.controller.on_output}, denominator, loop.plant.dead_time);
}

GeneralController controller(const TransferFunction& C) { return {C.numerator, C.numerator, C.denominator, {}}; }

GeneralController pid_controller(const ParallelForm& form, int n, double Tf) {
  const bool integral = form.Ki != 0;
  GeneralController c;
  c.denominator.assign(static_cast<std::size_t>(n), {1, Tf});
  if (integral) c.denominator.push_back({0, 1});
  c.on_output = trimmed(integral ? Polynomial{form.Ki, form.Kp, form.Kd} : Polynomial{form.Kp, form.Kd});
  c.on_setpoint = n > 0 ? c.on_output : trimmed(integral ? Polynomial{form.Ki, form.Kp} : Polynomial{form.Kp});
  return c;
}

GeneralController gains_controller(std::span<const double> gains, int n, double Tf) {
  PORTRAIT_CHECK(gains.size() >= 2 && n + 2 >= static_cast<int>(gains.size()));
  Polynomial N(gains.begin(), gains.end());
  const bool integral = N[0] != 0;
  if (!integral) N.erase(N.begin());
  GeneralController c;
  c.denominator.assign(static_cast<std::size_t>(n), {1, Tf});
  if (integral) c.denominator.push_back({0, 1});
  c.on_output = c.on_setpoint = trimmed(N);
  return c;
}

GeneralController with_weights(GeneralController controller, double b, double c) {
  const std::size_t proportional = has_root_at_0(controller.denominator) ? 1 : 0;
  Polynomial& N = controller.on_setpoint;
  PORTRAIT_CHECK(N.size() <= proportional + 2);
  if (N.size() > proportional) N[proportional] *= b;
  if (N.size() > proportional + 1) N[proportional + 1] *= c;
  N = trimmed(N);
  return controller;
}

GeneralLoop in_time_unit(const GeneralLoop& loop, double unit) {
  const GeneralController& c = loop.controller;
  GeneralLoop found;
  found.plant = {in_time_unit(loop.plant.rational, unit), loop.plant.dead_time / unit};
  found.controller.on_setpoint = in_time_unit(c.on_setpoint, unit);
  found.controller.on_output = in_time_unit(c.on_output, unit);
  for (const Polynomial& factor : c.denominator) found.controller.denominator.push_back(in_time_unit(factor, unit));
  found.controller.prefilter = in_time_unit(c.prefilter, unit);
  return found;
}

double usual_time_unit(const GeneralLoop& loop) {
  if (loop.plant.dead_time > 0) return loop.plant.dead_time;
  double sum = 0;
  for (const std::complex<double>& pole : roots(loop.plant.rational.denominator)) sum += 1 / std::abs(pole);
  if (sum > 0) return sum;
  const std::vector<double> crossovers = gain_crossovers(open_loop(loop));
  return crossovers.empty() ? 1 : 1 / crossovers.back();
}

NormalisedLoop normalised(const GeneralLoop& loop, std::optional<double> unit_without_dead_time) {
  const double usual = usual_time_unit(loop);
  const double unit = loop.plant.dead_time > 0 ? usual : unit_without_dead_time.value_or(usual);
  NormalisedLoop found{in_time_unit(loop, unit), {.time = unit, .gain = 1}};
  if (loop.plant.dead_time > 0) found.loop.plant.dead_time = 1;  // to the last bit
  Polynomial& numerator = found.loop.plant.rational.numerator;
  const Factored D = factored(found.loop.plant.rational.denominator), N = factored({numerator});
  found.units.gain = N.lowest / D.lowest;
  numerator = scaled(1 / found.units.gain, numerator);
  found.loop.controller.on_setpoint = scaled(found.units.gain, found.loop.controller.on_setpoint);
  found.loop.controller.on_output = scaled(found.units.gain, found.loop.controller.on_output);
  return found;
}

}  // namespace portrait
