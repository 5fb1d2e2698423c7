/// Model-based controllers jR^m for plants of equal lags, with the modified half rule.                     [Huba2021]

#include <fmt/format.h>

#include "engine/rules/families.h"
#include "engine/rules/half_rule.h"
#include "engine/rules/model_based.h"

namespace portrait::rules {
namespace {

constexpr std::string_view kName = "huba2021-jrm";

/// The plant as j equal lags: its own, fewer by the modified half rule, and the filter's share of both.      [Huba2021 (36)]
LagPlant lag_plant(const RulePlant& plant, const Choices& choices, int n, double Tf) {
  const auto lags = real_lags(plant);
  if (plant.integrators != 0 || !lags)
    fail_precondition(
        kName, fmt::format("it needs a stable plant of real lags without zeros, and \"{}\" is none", plant.name));
  const int count = static_cast<int>(lags->size());
  const int j = choices.has("lags") ? choices.whole("lags", 0, 8) : count;
  if (j > count) fail_precondition(kName, fmt::format("--lags {}: the plant has {}", j, count));
  if (j == 0 && count > 0) fail_precondition(kName, "--lags 0 is for a plant that is a dead time alone");
  const double share = n * Tf / 2;
  if (j == 0) return {0, plant.K, 0, plant.Td + 2 * share};
  const FewLags few = modified_half_rule(*lags, plant.Td, static_cast<std::size_t>(j));
  return {j, plant.K, few.lags[0] + share / j, few.dead_time + share};
}

DeadTimeQuotient quotient(const Choices& choices) {
  const std::string word = choices.word("dead-time", {"taylor", "pade1", "pade2"});
  return word == "taylor"  ? DeadTimeQuotient::taylor
         : word == "pade1" ? DeadTimeQuotient::pade_1
                           : DeadTimeQuotient::pade_2;
}

void set_prefilter(const Choices& choices, const LagPlant& p, double Tc, Tuned& t) {
  const std::string word = choices.word("prefilter", {"none", "step", "smooth"});
  if (word == "step") t.other_prefilter = step_prefilter(p, Tc);
  if (word == "smooth")
    t.other_prefilter = smooth_prefilter(p, choices.has("order") ? choices.whole("order", 1, p.j) : p.j);
}

/// K_c, which the papers print: the controller is K_c (1 + T_j s)/(T_j s) (...)/(...), so K_c/T_j is its integral gain.
double printed_gain(const LagPlant& p, double Tc) {
  return (p.j == 0 ? 1 : p.Tj) / (p.K * (std::max(p.j, 1) * Tc + p.Td));
}

Tuned model_based(const RulePlant& plant, const Choices& choices) {
  const double Tf = choices.has("Tf") ? choices.positive("Tf") : 0;
  const int n = Tf > 0 ? choices.whole("n", 1, kMaxFilterOrder) : 0;
  const LagPlant p = lag_plant(plant, choices, n, Tf);
  if (!choices.has("Tc") && !(p.Td > 0)) fail_precondition(kName, "without dead time Tc must be given: --Tc");
  const double Tc = choices.has("Tc") ? choices.positive("Tc") : p.Td;
  Tuned t;
  t.controller = model_based_controller(p, Tc, quotient(choices));
  t.n = n, t.Tf = Tf;
  set_prefilter(choices, p, Tc, t);
  t.findings = {{"j", static_cast<double>(p.j)},
                {"Tj", p.Tj},
                {"Td_used", p.Td},
                {"Tc", Tc},
                {p.j == 0 ? "Ki" : "Kc", printed_gain(p, Tc)}};
  // With one lag and a Taylor series it is a PI.
  if (p.j == 1 && t.controller.denominator.size() == 2) t.pid = StandardForm{printed_gain(p, Tc), p.Tj, 0};
  return t;
}

}  // namespace

std::vector<Rule> huba2021_rules() {
  return {{kName,
           "of any order",
           "fotd, jotd, tf with real lags, a dead time alone",
           "target e^(-Td s)/(Tc s + 1)^j; lags beyond j and the filter by the modified half rule",
           "Huba2021 (2)-(32), (36), (55), (72)-(74)",
           {{"Tc", "time constant of the target (without it: the dead time)", ""},
            {"lags", "lags to keep, 0 .. 8 (without it: all)", ""},
            {"dead-time", "its quotient: taylor, pade1, pade2", "taylor"},
            {"prefilter", "none, step ((Tc s + 1)/(Tj s + 1))^j, smooth 1/(Tj s + 1)^order", "none"},
            {"order", "of the prefilter smooth (without it: j)", ""},
            {"Tf", "time constant of the filter 1/(Tf s + 1)^n", ""},
            {"n", "order of the filter", "1"}},
           model_based}};
}

}  // namespace portrait::rules
