/// The field's usual comparisons in the catalogue: SIMC, iSIMC, Ziegler-Nichols, Tyreus-Luyben, IMC, AMIGO, and the rules
/// the thesis compares with.

#include <cmath>

#include <fmt/format.h>

#include "engine/rules/families.h"
#include "engine/rules/half_rule.h"
#include "engine/rules/plants.h"
#include "engine/rules/step_response_rules.h"

namespace portrait::rules {
namespace {

struct Filter {
  int n = 0;
  double Tf = 0;
};
Filter filter(const Choices& choices) {
  if (!choices.has("Tf")) return {};
  return {choices.whole("n", 1, kMaxFilterOrder), choices.positive("Tf")};
}

/// The lags kept and the dead time of plant and filter together, by the half rule.            [Huba2021 (79), (99)]
FewLags reduced(std::string_view rule, const RulePlant& plant, const Filter& f, std::size_t most) {
  auto lags = real_lags(plant);
  if (!lags)
    fail_precondition(rule,
                      fmt::format("it needs a plant of real lags without zeros, and \"{}\" is none", plant.name));
  lags->insert(lags->end(), static_cast<std::size_t>(f.n), f.Tf);
  if (lags->size() <= most) return {*lags, plant.Td};
  return half_rule(*lags, plant.Td, most);
}

/// Given, or this many dead times.
double target(std::string_view rule, const Choices& choices, double dead_time, double usual) {
  if (choices.has("Tc")) return choices.positive("Tc");
  if (!(dead_time > 0)) fail_precondition(rule, "without dead time Tc must be given: --Tc");
  return usual * dead_time;
}

/// n = 0 for an ideal controller; the setpoint zero of a PI is left in unless the user cancels it.
Tuned with_filter(const StandardForm& form, const Filter& f, std::vector<Finding> findings) {
  Tuned t = tuned(form);
  t.n = f.n, t.Tf = f.Tf;
  t.findings = std::move(findings);
  return t;
}

/// On an integrator a filter is a lag more, and its lag goes to the dead time in halves with nothing kept.
StandardForm simc_pi_of(std::string_view rule, const RulePlant& plant, const Choices& choices, const Filter& f,
                        std::vector<Finding>& findings, bool improved) {
  if (plant.integrators == 1) {
    const FewLags all = reduced(rule, plant, f, 0 + 16);
    double tau = plant.Td;
    for (std::size_t i = 0; i < all.lags.size(); ++i) tau += all.lags[i];
    const double Tc = target(rule, choices, tau, 1);
    findings = {{"k", plant.K}, {"tau", tau}, {"Tc", Tc}};
    return simc_pi(IntegratingPlant{plant.K, tau}, Tc);
  }
  if (plant.integrators != 0) fail_precondition(rule, "a PI does not stabilise two integrators: simc-pid does");
  const FewLags few = reduced(rule, plant, f, 1);
  if (few.lags.empty())
    fail_precondition(rule, "the plant is a dead time alone: give it a lag, or take huba2021-jrm with --lags 0");
  const double Tc = target(rule, choices, few.dead_time, 1);
  findings = {{"K", plant.K}, {"T", few.lags[0]}, {"tau", few.dead_time}, {"Tc", Tc}};
  const LagDelayPlant p{plant.K, few.lags[0], few.dead_time};
  return improved ? isimc_pi(p, Tc) : simc_pi(p, Tc);
}

Tuned simc_pi_rule(const RulePlant& plant, const Choices& choices) {
  const Filter f = filter(choices);
  std::vector<Finding> findings;
  const StandardForm form = simc_pi_of("simc-pi", plant, choices, f, findings, false);
  return with_filter(form, f, findings);
}

Tuned isimc_pi_rule(const RulePlant& plant, const Choices& choices) {
  const Filter f = filter(choices);
  std::vector<Finding> findings;
  const StandardForm form = simc_pi_of("isimc-pi", plant, choices, f, findings, true);
  return with_filter(form, f, findings);
}

SeriesForm simc_pid_of(std::string_view rule, const RulePlant& plant, const Choices& choices, const Filter& f,
                       std::vector<Finding>& findings) {
  if (plant.integrators == 2) {
    const FewLags all = reduced(rule, plant, f, 16);
    double tau = plant.Td;
    for (const double T : all.lags) tau += T;
    const double Tc = target(rule, choices, tau, 1);
    findings = {{"k", plant.K}, {"tau", tau}, {"Tc", Tc}};
    return simc_double_integrator(plant.K, tau, Tc);
  }
  const bool integrating = plant.integrators == 1;
  const FewLags few = reduced(rule, plant, f, integrating ? 1 : 2);
  if (few.lags.size() < (integrating ? 1u : 2u))
    fail_precondition(rule,
                      "its derivative time is the second lag (behind an integrator: the first), and the plant has "
                      "none: take isimc-pid");
  const double Tc = target(rule, choices, few.dead_time, 1);
  findings = {{"T2", few.lags.back()}, {"tau", few.dead_time}, {"Tc", Tc}};
  const StandardForm pi = integrating ? simc_pi(IntegratingPlant{plant.K, few.dead_time}, Tc)
                                      : simc_pi(LagDelayPlant{plant.K, few.lags[0], few.dead_time}, Tc);
  return {.Kc = pi.Kc, .Ti = pi.Ti, .TD = few.lags.back()};
}

/// The filter on the derivative that SIMC leaves to the user, alpha TD, takes no share of the dead time.
Tuned series_rule(const SeriesForm& form, const Choices& choices, Filter f, std::vector<Finding> findings) {
  findings.insert(findings.begin(), {{"series_Kc", form.Kc}, {"series_Ti", form.Ti}, {"series_TD", form.TD}});
  if (choices.has("alpha") && f.n == 0) f = {1, choices.positive("alpha") * form.TD};
  Tuned t = with_filter(standard(form), f, std::move(findings));
  if (t.n == 0) t.prefilter = Prefilter::none;
  return t;
}

Tuned simc_pid_rule(const RulePlant& plant, const Choices& choices) {
  const Filter f = filter(choices);
  std::vector<Finding> findings;
  const SeriesForm form = simc_pid_of("simc-pid", plant, choices, f, findings);
  return series_rule(form, choices, f, findings);
}

Tuned isimc_pid_rule(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "isimc-pid";
  const Filter f = filter(choices);
  if (plant.integrators == 1) {
    double tau = plant.Td;
    for (const double T : reduced(kName, plant, f, 16).lags) tau += T;
    const double Tc = target(kName, choices, tau, 0.5);
    return series_rule(isimc_pid(IntegratingPlant{plant.K, tau}, Tc), choices, f, {{"tau", tau}, {"Tc", Tc}});
  }
  if (plant.integrators != 0)
    fail_precondition(kName, "it needs a plant with at most one integrator: simc-pid takes two");
  const FewLags few = reduced(kName, plant, f, 1);
  if (few.lags.empty()) fail_precondition(kName, "the plant is a dead time alone");
  const double Tc = target(kName, choices, few.dead_time, 0.5);
  return series_rule(isimc_pid(LagDelayPlant{plant.K, few.lags[0], few.dead_time}, Tc), choices, f,
                     {{"T", few.lags[0]}, {"tau", few.dead_time}, {"Tc", Tc}});
}

Tuned imc_rule(const RulePlant& plant, const Choices& choices) {
  const IntegratingPlant p = as_integrating("imc-pi", plant);
  const double Tc = target("imc-pi", choices, p.tau, std::sqrt(10.0));
  return with_filter(imc_pi(p, Tc), {}, {{"k", p.k}, {"tau", p.tau}, {"Tc", Tc}});
}

/// A formula for both kinds of plant: integrators as they are, everything else as one lag by the half rule.
template <typename OfIntegrating, typename OfLag>
Tuned by_kind(std::string_view rule, const RulePlant& plant, OfIntegrating of_integrating, OfLag of_lag) {
  if (is_ipdt(plant)) {
    need_dead_time(rule, plant.Td);
    return with_filter(of_integrating(IntegratingPlant{plant.K, plant.Td}), {},
                       {{"k", plant.K}, {"tau", plant.Td}});
  }
  const LagDelayPlant p = as_lag_delay(rule, plant);
  need_dead_time(rule, p.tau);
  return with_filter(of_lag(p), {}, {{"K", p.K}, {"T", p.T}, {"tau", p.tau}});
}

template <StandardForm (*of)(const Ultimate&)>
Tuned by_ultimate(std::string_view rule, const RulePlant& plant) {
  Ultimate u{};
  const auto note = [&u](const auto& p) { return of(u = ultimate(p)); };
  Tuned t = by_kind(rule, plant, note, note);
  t.findings.insert(t.findings.end(), {{"Ku", u.gain}, {"Pu", u.period}});
  return t;
}

Tuned zn_pi(const RulePlant& plant, const Choices&) { return by_ultimate<ziegler_nichols_pi>("zn-pi", plant); }
Tuned zn_pid(const RulePlant& plant, const Choices&) { return by_ultimate<ziegler_nichols_pid>("zn-pid", plant); }
Tuned tl_pi(const RulePlant& plant, const Choices&) {
  return by_ultimate<tyreus_luyben_pi>("tyreus-luyben-pi", plant);
}
Tuned tl_pid(const RulePlant& plant, const Choices&) {
  return by_ultimate<tyreus_luyben_pid>("tyreus-luyben-pid", plant);
}
Tuned amigo_pi_rule(const RulePlant& plant, const Choices&) {
  const auto formula = [](const auto& p) { return amigo_pi(p); };
  return by_kind("amigo-pi", plant, formula, formula);
}
Tuned amigo_pid_rule(const RulePlant& plant, const Choices&) {
  const auto formula = [](const auto& p) { return amigo_pid(p); };
  return by_kind("amigo-pid", plant, formula, formula);
}

/// Weights as the prefilter they equal.                                                    [Kos2021 (4.18), (5.19)]
Tuned weighted(const WeightedPid& found, const Choices& choices, std::vector<Finding> findings) {
  Tuned t = with_filter(found.form, filter(choices), std::move(findings));
  if (t.n == 0)
    t.prefilter = Prefilter::pi, t.b = found.b;
  else
    t.prefilter = Prefilter::full, t.b = found.b * found.form.Ti, t.c = found.c * found.form.Ti * found.form.TD;
  t.findings.insert(t.findings.end(), {{"b", found.b}, {"c", found.c}});
  return t;
}

void need_one_integrator(std::string_view rule, const RulePlant& plant) {
  if (plant.integrators != 1) fail_precondition(rule, "it needs a plant with one integrator");
}

Tuned kappa_tau(std::string_view rule, const RulePlant& plant, const Choices& choices, bool derivative) {
  need_one_integrator(rule, plant);
  const std::string Ms = choices.word("Ms", {"1.4", "2"});
  Polynomial D{1};
  for (const Polynomial& p : plant.poles) D = product(D, p);
  if (plant.poles.empty() ? plant.zeros.size() > 1 : plant.zeros.size() >= D.size())
    fail_precondition(rule, "the plant without its integrator must not jump");
  const auto tangent = steepest_tangent(plant.zeros, D, plant.Td);
  if (!tangent || !(tangent->L + tangent->T > 0))
    fail_precondition(rule, "the plant without its integrator has no steepest tangent");
  const auto of = derivative ? kappa_tau_pid : kappa_tau_pi;
  return weighted(of(plant.K, *tangent, Ms == "2"), choices, {{"L", tangent->L}, {"T", tangent->T}});
}
Tuned kappa_tau_pi_rule(const RulePlant& p, const Choices& c) { return kappa_tau("kappa-tau-pi", p, c, false); }
Tuned kappa_tau_pid_rule(const RulePlant& p, const Choices& c) { return kappa_tau("kappa-tau-pid", p, c, true); }

Tuned taguchi(std::string_view rule, const RulePlant& plant, const Choices& choices, bool derivative) {
  need_one_integrator(rule, plant);
  need_dead_time(rule, plant.Td);
  const auto lags = real_lags(plant);
  const bool equal = lags && (lags->size() < 2 || (*lags)[0] - (*lags)[1] <= 1e-6 * (*lags)[0]);
  if (!equal || lags->size() > 2)
    fail_precondition(rule, "besides the integrator it takes no lag, one, or two equal ones");
  const auto of = derivative ? taguchi_pid : taguchi_pi;
  const double T = lags->empty() ? 0 : lags->front();
  return weighted(of(plant.K, plant.Td, T, static_cast<int>(lags->size())), choices, {});
}
Tuned taguchi_pi_rule(const RulePlant& p, const Choices& c) { return taguchi("taguchi-pi", p, c, false); }
Tuned taguchi_pid_rule(const RulePlant& p, const Choices& c) { return taguchi("taguchi-pid", p, c, true); }

}  // namespace

// Long: one row a rule, wrapped by its formatter.
std::vector<Rule> field_rules() {
  const OptionInfo Tc = {"Tc", "time constant of the target", ""};
  const OptionInfo Tf = {"Tf", "time constant of the filter 1/(Tf s + 1)^n", ""},
                   n = {"n", "order of the filter", "1"};
  const OptionInfo alpha = {"alpha", "filter constant over TD, not counted as dead time, in place of --Tf", ""};
  const OptionInfo Ms = {"Ms", "1.4 or 2", "1.4"};
  constexpr std::string_view kLags = "ipdt, fotd, jotd, tf with real lags";
  return {
      {"simc-pi",
       "PI",
       kLags,
       "lags beyond the first by the half rule",
       "Skogestad2003; Huba2021 (79), Dalen2018 (13)",
       {Tc, Tf, n},
       simc_pi_rule},
      {"simc-pid",
       "PID",
       "two lags or more, an integrator and a lag, dipdt",
       "series PID, lags beyond the second by the half rule",
       "Skogestad2003; Huba2021 (77)",
       {Tc, Tf, n, alpha},
       simc_pid_rule},
      {"isimc-pi", "PI", kLags, "SIMC with Td/3 added to the lag", "Grimholt2018", {Tc, Tf, n}, isimc_pi_rule},
      {"isimc-pid",
       "PID",
       kLags,
       "SIMC PI and TD = Td/3",
       "Grimholt2018; Huba2021 (80)",
       {Tc, Tf, n, alpha},
       isimc_pid_rule},
      {"imc-pi", "PI", "ipdt, fotd as ipdt", "internal model control", "Chien1990; Dalen2018 1.2", {Tc}, imc_rule},
      {"zn-pi", "PI", kLags, "from ultimate gain and period", "ZieglerNichols1942", {}, zn_pi},
      {"zn-pid", "PID", kLags, "from ultimate gain and period", "ZieglerNichols1942", {}, zn_pid},
      {"tyreus-luyben-pi", "PI", kLags, "from ultimate gain and period", "TyreusLuyben1992", {}, tl_pi},
      {"tyreus-luyben-pid", "PID", kLags, "from ultimate gain and period", "TyreusLuyben1992", {}, tl_pid},
      {"amigo-pi", "PI", kLags, "robust step-response rule", "AstromHagglund2006", {}, amigo_pi_rule},
      {"amigo-pid", "PID", kLags, "robust step-response rule", "AstromHagglund2006", {}, amigo_pid_rule},
      {"kappa-tau-pi",
       "PI",
       "any with one integrator",
       "step-response rule of the plant without its integrator",
       "AstromHagglund1995",
       {Ms, Tf, n},
       kappa_tau_pi_rule},
      {"kappa-tau-pid",
       "PID",
       "any with one integrator",
       "step-response rule of the plant without its integrator",
       "AstromHagglund1995",
       {Ms, Tf, n},
       kappa_tau_pid_rule},
      {"taguchi-pi",
       "PI",
       "an integrator and 0, 1 or 2 equal lags",
       "fitted formulas with setpoint weights",
       "TaguchiAraki2000",
       {Tf, n},
       taguchi_pi_rule},
      {"taguchi-pid",
       "PID",
       "an integrator and 0, 1 or 2 equal lags",
       "fitted formulas with setpoint weights",
       "TaguchiAraki2000",
       {Tf, n},
       taguchi_pid_rule},
  };
}

}  // namespace portrait::rules
