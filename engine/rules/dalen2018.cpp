/// PI rules for integrators with dead time: delta-tuning, its variants, and the Pareto front it is compared with. [Dalen2018]

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/rules/families.h"
#include "engine/rules/pareto_pi.h"
#include "engine/rules/plants.h"
#include "engine/rules/reaction_curve.h"

namespace portrait::rules {
namespace {

Tuned pi(const StandardForm& form, std::vector<Finding> findings) {
  Tuned t = tuned(form);
  t.findings = std::move(findings);
  return t;
}

Tuned delta_rule(const RulePlant& plant, const Choices& choices) {
  const IntegratingPlant p = as_integrating("dalen2018-delta", plant);
  const double cbar = choices.positive("cbar");
  const double margin = choices.has("dtau") ? choices.positive("dtau") : choices.positive("delta") * p.tau;
  if (!(margin > 0))
    fail_precondition("dalen2018-delta", "without dead time the margin must be given in time: --dtau");
  return pi(delta_tuning_by_margin(p, cbar, margin),
            {{"k", p.k}, {"tau", p.tau}, {"a", method_product_a(cbar)}, {"DM", margin}});
}

Tuned ms_rule(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "dalen2018-delta-ms";
  const double cbar = choices.positive("cbar"), Ms = choices.positive("Ms");
  const PiLoop loop = pi_loop_of(kName, plant);
  const auto form = pi_of_sensitivity(loop, cbar, Ms);
  if (!form)
    fail_precondition(kName, fmt::format("no PI with cbar = {} has Ms = {}: it is higher for all", cbar, Ms));
  const double delta = method_product_a(cbar) / (form->Kc * loop.scale.k * loop.scale.tau) - 1;
  return pi(*form, {{"k", loop.scale.k}, {"tau", loop.scale.tau}, {"delta", delta}});
}

Tuned pade_rule(const RulePlant& plant, const Choices& choices) {
  const IntegratingPlant p = as_integrating("dalen2018-pade", plant);
  if (!(p.tau > 0)) fail_precondition("dalen2018-pade", "it needs a dead time above 0");
  const double c = choices.has("c") ? choices.within("c", 1, 10) : pade_triple_root();
  const StandardForm form = pade_tuning(p, c);
  return pi(form, {{"k", p.k}, {"tau", p.tau}, {"c", c}, {"cbar", form.Kc * form.Ti * p.k}});
}

/// k and tau from the tangent of the plant's own step response.
IntegratingPlant by_reaction_curve(std::string_view rule, const RulePlant& plant, double zeta) {
  Polynomial N = plant.zeros, D{1};
  for (double& a : N) a *= plant.K;
  for (int i = 0; i < plant.integrators; ++i) D = product(D, {0, 1});
  for (const Polynomial& p : plant.poles) D = product(D, p);
  if (N.size() >= D.size())
    fail_precondition(rule, "the step response of the plant jumps: it has no steepest tangent");
  const auto curve = reaction_curve(N, D, plant.Td);
  if (!curve) fail_precondition(rule, "the step response of the plant grows ever steeper");
  if (!(curve->lag > 0))
    fail_precondition(rule, "the tangent of the step response has no lag: there is no dead time to tune by");
  return {curve->slope * zeta, curve->lag};
}

Tuned reaction_curve_rule(const RulePlant& plant, const Choices& choices) {
  const IntegratingPlant p = by_reaction_curve("dalen2018-prc", plant, choices.positive("zeta"));
  const double cbar = choices.positive("cbar"), delta = choices.positive("delta");
  return pi(delta_tuning(p, cbar, delta), {{"k", p.k}, {"tau", p.tau}, {"a", method_product_a(cbar)}});
}

Tuned pareto_rule(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "dalen2018-pareto";
  const double Ms = choices.positive("Ms"), s_r = choices.within("sr", 0, 1);
  if (!(Ms > 1)) fail_precondition(kName, fmt::format("Ms is above 1 for every loop (asked for: {})", Ms));
  const PiLoop loop = pi_loop_of(kName, plant);
  if (loop.integrating && s_r == 1)
    fail_precondition(kName, "on an integrating plant sr = 1 ends in P control: give --sr below 1");
  const auto found = pareto_pi(loop, Ms, s_r);
  if (!found) fail_precondition(kName, fmt::format("no PI has Ms = {}", Ms));
  return pi({found->Kp, found->Ti, 0}, {{"cbar", found->cbar},
                                        {"J", found->J},
                                        {"IAE_vy", found->errors.IAE_vy},
                                        {"IAE_vu", found->errors.IAE_vu},
                                        {"least_IAE_vy", found->least.IAE_vy},
                                        {"least_IAE_vu", found->least.IAE_vu}});
}

constexpr OptionInfo kCbar = {"cbar", "method product Kp Ti k", "2.5"};
constexpr OptionInfo kMs = {"Ms", "peak of the sensitivity function", "1.59"};

}  // namespace

std::vector<Rule> dalen2018_rules() {
  const OptionInfo delta = {"delta", "delay margin over the dead time", "1.6"};
  return {
      {"dalen2018-delta",
       "PI",
       "ipdt, fotd as ipdt",
       "delay margin delta Td (Algorithm 1)",
       "Dalen2018 (20)-(29)",
       {kCbar, delta, {"dtau", "delay margin in time, in place of delta", ""}},
       delta_rule},
      {"dalen2018-delta-ms",
       "PI",
       "ipdt, fotd",
       "Algorithm 1 with the delta that gives Ms",
       "Dalen2018 1.4",
       {kCbar, kMs},
       ms_rule},
      {"dalen2018-pade",
       "PI",
       "ipdt, fotd as ipdt",
       "three equal poles c Td with a (2,1) Pade quotient",
       "Dalen2018 (30)-(40)",
       {{"c", "time constant of the poles over the dead time", ""}},
       pade_rule},
      {"dalen2018-prc",
       "PI",
       "any with a steepest tangent",
       "Algorithm 1 on the process reaction curve",
       "Dalen2018 6, 1.8",
       {kCbar, delta, {"zeta", "factor on the tangent's slope", "1"}},
       reaction_curve_rule},
      {"dalen2018-pareto",
       "PI",
       "ipdt, fotd",
       "least weighted IAE of both steps at Ms, found by simulation",
       "Dalen2018 (41), (46)",
       {kMs, {"sr", "weight of the setpoint against the disturbance, 0 .. 1", "0.5"}},
       pareto_rule},
  };
}

}  // namespace portrait::rules
