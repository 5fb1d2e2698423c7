/// Rules for a double integrator with dead time by real dominant poles.                                    [Huba2022]

#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/rules/families.h"
#include "engine/rules/real_dominant_poles.h"

namespace portrait::rules {
namespace {

void need_dipdt(std::string_view rule, const RulePlant& plant) {
  if (plant.integrators != 2 || plant.zeros.size() > 1 || !plant.poles.empty())
    fail_precondition(rule, fmt::format("it needs a dipdt plant, K e^(-Td s)/s^2, and \"{}\" is none", plant.name));
  if (!(plant.Td > 0)) fail_precondition(rule, "it needs a dead time above 0");
}

/// Poles to cancel from the setpoint response, by how often each time constant is among them.
struct Cancelled {
  std::string_view word;
  int T_o, m_T_o;
};
constexpr Cancelled kCancelled[] = {{"none", 0, 0}, {"To", 1, 0},   {"mTo", 0, 1},
                                    {"2To", 2, 0},  {"2mTo", 0, 2}, {"To+mTo", 1, 1}};

Cancelled cancelled(const Choices& choices) {
  std::vector<std::string_view> words;
  for (const Cancelled& c : kCancelled) words.push_back(c.word);
  const std::string word = choices.word("cancel", words);
  for (const Cancelled& c : kCancelled)
    if (c.word == word) return c;
  return kCancelled[0];
}

/// The dead time the rule works with: the plant's and what stands for the filter.             [Huba2022 (40), (41)]
struct Filter {
  int n;
  double Tf, dead_time;
};
Filter filter(const RulePlant& plant, const Choices& choices) {
  if (!choices.has("Tf")) return {0, 0, plant.Td};
  const int n = choices.whole("n", 1, kMaxFilterOrder);
  const double Tf = choices.positive("Tf"), N = choices.within("N", 0.5, 1);
  return {n, Tf, plant.Td + n * N * Tf};
}

/// Numerators (25), (26), (38) as 1 + b s + c s^2, the product of the factors cancelled.
void set_prefilter(std::string_view rule, const Cancelled& cancel, double T_o, double m, Tuned& t) {
  Polynomial numerator{1};
  for (int i = 0; i < cancel.T_o; ++i) numerator = product(numerator, {1, T_o});
  for (int i = 0; i < cancel.m_T_o; ++i) numerator = product(numerator, {1, m * T_o});
  const double b = numerator.size() > 1 ? numerator[1] : 0, c = numerator.size() > 2 ? numerator[2] : 0;
  if (t.n >= 1) {
    t.prefilter = Prefilter::full, t.b = b, t.c = c;
    return;
  }
  // Without a filter the derivative acts on the output alone, and (1 + b s)/(1 + Ti s) gives the same response.
  t.prefilter = Prefilter::pi;
  if (c != 0 || (b != 0 && std::isinf(t.pid->Ti)))
    fail_precondition(rule,
                      "this prefilter needs a filtered controller: give --Tf, or --cancel with one pole or none");
  t.b = std::isinf(t.pid->Ti) ? 0 : b / t.pid->Ti;
}

/// From normalised numbers to the plant's, all times in units of the dead time that was used.
Tuned in_real_units(std::string_view rule, const RulePlant& plant, const Choices& choices, const Filter& filter,
                    const RealPolesTuning& r, double m, const Cancelled& cancel) {
  const double Td = filter.dead_time, T_o = -Td / r.p_o;
  Tuned t = tuned(StandardForm{r.kappa / (plant.K * Td * Td), r.tau_i * Td, r.delta / r.kappa * Td});
  t.n = filter.n, t.Tf = filter.Tf;
  set_prefilter(rule, cancel, T_o, m, t);
  t.findings = {{"p_o", r.p_o}, {"T_o", T_o}, {"dead_time_used", Td}};
  if (choices.has("m")) t.findings.push_back({"m_T_o", m * T_o});
  return t;
}

void check_multiplicity(std::string_view rule, const Cancelled& c, int of_T_o, int of_m_T_o) {
  if (c.T_o > of_T_o || c.m_T_o > of_m_T_o)
    fail_precondition(rule, fmt::format("--cancel {}: the loop has {} poles -1/To and {} poles -1/(m To)", c.word,
                                        of_T_o, of_m_T_o));
}

Tuned trdp(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "huba2022-trdp";
  need_dipdt(kName, plant);
  const Filter f = filter(plant, choices);
  const Cancelled cancel = choices.has("cancel") ? cancelled(choices) : f.n >= 1 ? kCancelled[1] : kCancelled[0];
  check_multiplicity(kName, cancel, 3, 0);
  return in_real_units(kName, plant, choices, f, triple_real_pole(), 1, cancel);
}

Tuned four_poles(std::string_view rule, PoleSet set, double m, const RulePlant& plant, const Choices& choices) {
  need_dipdt(rule, plant);
  const auto solved = four_real_poles(set, m);
  if (!solved || !(solved->kappa > 0) || !(solved->tau_i > 0))
    fail_precondition(rule, fmt::format("four real poles with m = {} have no stabilising PID", m));
  const Cancelled cancel = cancelled(choices);
  const int of_T_o = static_cast<int>(set);
  if (choices.has("m"))
    check_multiplicity(rule, cancel, of_T_o, 4 - of_T_o);
  else
    check_multiplicity(rule, cancel, 4, 0);
  return in_real_units(rule, plant, choices, filter(plant, choices), *solved, m, cancel);
}

Tuned qrdp(const RulePlant& plant, const Choices& choices) {
  return four_poles("huba2022-qrdp", PoleSet::two_modified, 1, plant, choices);
}
Tuned mfrp_one(const RulePlant& plant, const Choices& choices) {
  return four_poles("huba2022-mfrp1", PoleSet::one_modified, choices.positive("m"), plant, choices);
}
Tuned mfrp_two(const RulePlant& plant, const Choices& choices) {
  return four_poles("huba2022-mfrp2", PoleSet::two_modified, choices.positive("m"), plant, choices);
}
Tuned mfrp_three(const RulePlant& plant, const Choices& choices) {
  return four_poles("huba2022-mfrp3", PoleSet::three_modified, choices.positive("m"), plant, choices);
}

std::vector<OptionInfo> options(bool has_m, std::string_view cancel) {
  std::vector<OptionInfo> all = {
      {"Tf", "time constant of the filter 1/(Tf s + 1)^n", ""},
      {"n", "order of the filter", "1"},
      {"N", "share of n Tf that counts as dead time, 0.5 .. 1", "1"},
      {"cancel", "poles the prefilter cancels: none, To, mTo, 2To, 2mTo or To+mTo", cancel}};
  if (has_m) all.insert(all.begin(), {"m", "ratio of the two real poles, p_o : p_o/m", "2"});
  return all;
}

}  // namespace

std::vector<Rule> huba2022_rules() {
  return {
      {"huba2022-trdp", "PD", "dipdt", "triple real dominant pole", "Huba2022 (11)-(16)", options(false, ""), trdp},
      {"huba2022-qrdp", "PID", "dipdt", "quadruple real dominant pole", "Huba2022 (21)-(27)", options(false, "To"),
       qrdp},
      {"huba2022-mfrp1", "PID", "dipdt", "real poles p_o three times, p_o/m once", "Huba2022 (29)",
       options(true, "To"), mfrp_one},
      {"huba2022-mfrp2", "PID", "dipdt", "real poles p_o and p_o/m, each twice", "Huba2022 (33)",
       options(true, "To"), mfrp_two},
      {"huba2022-mfrp3", "PID", "dipdt", "real poles p_o once, p_o/m three times", "Huba2022 (37)",
       options(true, "To"), mfrp_three},
  };
}

}  // namespace portrait::rules
