/// Magnitude-optimum PI and PID for plants with one integrator.                                              [Kos2021]

#include <fmt/format.h>

#include "engine/rules/area_model.h"
#include "engine/rules/families.h"

namespace portrait::rules {
namespace {

Areas integrating_areas(std::string_view rule, const RulePlant& plant, std::size_t count) {
  if (plant.integrators != 1)
    fail_precondition(rule, fmt::format("it needs a plant with one integrator, and \"{}\" has {}", plant.name,
                                        plant.integrators));
  Areas areas = areas_of(plant, count);
  if (areas[1] == 0) fail_precondition(rule, "the area A_1 is 0: an integrator alone has no optimum");
  return areas;
}

std::vector<Finding> shown(const Areas& areas, std::initializer_list<Finding> more) {
  std::vector<Finding> all;
  for (std::size_t i = 0; i < areas.size(); ++i) all.push_back({fmt::format("A_{}", i), areas[i]});
  all.insert(all.end(), more);
  return all;
}

/// Weights b on the proportional and the derivative part as the prefilter they equal.        [Kos2021 (4.18), (5.19)]
void set_weight(double b, Tuned& t) {
  if (t.pid->Ti == kInf) return;  // b = 1
  const StandardForm& form = *t.pid;
  if (t.n == 0)
    t.prefilter = Prefilter::pi, t.b = b;
  else
    t.prefilter = Prefilter::full, t.b = b * form.Ti, t.c = b * form.Ti * form.TD;
}

Tuned pi(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "kos2021-pi";
  const Areas A = integrating_areas(kName, plant, 3);
  const double b = choices.within("b", 0, 1);
  auto form = integrating_pi(A, b);
  if (!form)
    fail_precondition(
        kName, "A_1^2 + (1 - b^2)(A_0 A_2 - A_1^2) < 0, the gain would be complex: the plant oscillates too much");
  const double T = residence_time(A, *form, b) * choices.positive("KCL");
  if (choices.positive("KCL") != 1) form = integrating_pi_of_speed(A, b, T);
  Tuned t = tuned(standard(*form));
  set_weight(b, t);
  t.findings = shown(A, {{"TCL", T}});
  return t;
}

struct FilteredPid {
  double Tf;
  Areas areas;  ///< with the filter
  ParallelForm form;
};

std::optional<FilteredPid> found_pid(const Areas& plant, double b, double Tf) {
  const Areas with_filter = filtered(plant, Tf, 1);
  const auto form = integrating_pid(with_filter, b);
  if (!form) return std::nullopt;
  return FilteredPid{Tf, with_filter, *form};
}

FilteredPid pid_with_filter(std::string_view rule, const Areas& plant, double b, double Tf) {
  const auto found = found_pid(plant, b, Tf);
  if (!found)
    fail_precondition(rule, "the quartic (5.11) for Ti has no positive root: the plant oscillates too much");
  return *found;
}

/// Tf given, or in turn with the gains until Kd/Tf = K_HF.                                   [Kos2021 (5.3), Remark 5.3]
FilteredPid filtered_pid(std::string_view rule, const Areas& plant, double b, const Choices& choices) {
  if (choices.has("Tf")) return pid_with_filter(rule, plant, b, choices.positive("Tf"));
  if (!choices.has("KHF")) fail_precondition(rule, "its controller has a filter: give --Tf, or --KHF for Kd/Tf");
  const double K_HF = choices.positive("KHF");
  std::optional<FilteredPid> found = pid_with_filter(rule, plant, b, 0);
  for (int turn = 0; found && turn < 200; ++turn) {
    const double next = std::abs(found->form.Kd) / K_HF;
    if (std::abs(next - found->Tf) <= 1e-14 * next) return *found;
    found = found_pid(plant, b, next);
  }
  fail_precondition(rule, fmt::format("no filter constant gives Kd/Tf = {}", K_HF));
}

Tuned finished(const FilteredPid& found, const ParallelForm& form, double b) {
  Tuned t = tuned(standard(form));
  t.n = 1, t.Tf = found.Tf;
  set_weight(b, t);
  return t;
}

Tuned pid(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "kos2021-pid";
  const double b = choices.within("b", 0, 0.99);
  const FilteredPid found = filtered_pid(kName, integrating_areas(kName, plant, 5), b, choices);
  const double slowdown = choices.positive("KCL"), T = residence_time(found.areas, found.form, b) * slowdown;
  const ParallelForm form = slowdown == 1 ? found.form : *integrating_pid_of_speed(found.areas, b, T);
  Tuned t = finished(found, form, b);
  t.findings = shown(found.areas, {{"TCL", T}, {"TCL_max", slowest_pid(found.areas, b)}, {"Tf", found.Tf}});
  return t;
}

ParallelForm need_pd(std::string_view rule, const Areas& with_filter) {
  const auto form = integrating_pd(with_filter);
  if (!form) fail_precondition(rule, "A_1 A_2 = A_0 A_3: the gains of the PD controller would be infinite");
  return *form;
}

Tuned pd(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "kos2021-pd";
  const double Tf = choices.positive("Tf");
  const Areas A = filtered(integrating_areas(kName, plant, 4), Tf, 1);
  const ParallelForm form = need_pd(kName, A);
  Tuned t = tuned(standard(form));
  t.n = 1, t.Tf = Tf;
  t.findings = shown(A, {{"TCL", 1 / (A[0] * form.Kp)}});
  return t;
}

Tuned pid_f2(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "kos2021-pid-f2";
  const FilteredPid found = filtered_pid(kName, integrating_areas(kName, plant, 5), 0, choices);
  const auto [b1, b2] = reference_filter_2(found.areas, found.form, need_pd(kName, found.areas));
  Tuned t = finished(found, found.form, 0);
  t.b = b1, t.c = b2;
  t.findings = shown(found.areas, {{"b_F1", b1}, {"b_F2", b2}, {"Tf", found.Tf}});
  return t;
}

AreaModel model(std::string_view rule, const Areas& A, const Choices& choices) {
  if (choices.has("Tdm")) return model_with_dead_time(A, choices.number("Tdm"));
  if (const auto plain = model_without_zero(A)) return *plain;
  if (const auto zero = model_with_zero(A, false)) return *zero;
  fail_precondition(rule, "no model with real dead time has the areas of the plant: give one, --Tdm");
}

/// (1 + b_F1 s + ... + b_F5 s^5) over the closed loop's denominator without its dead time.            [Kos2021 (5.41)]
Quotient higher_reference_filter(const AreaModel& m, const ParallelForm& pid, double Tf, double T_CL, int n) {
  const std::array<double, 5> b = reference_filter_5(m, pid, Tf);
  Polynomial numerator{1};
  numerator.insert(numerator.end(), b.begin(), b.end());
  return {numerator, product(product({1, pid.Kp / pid.Ki, pid.Kd / pid.Ki}, {1, m.Td / 2, m.Td * m.Td / 12}),
                             lag_power(T_CL / n, n))};
}

Tuned pid_fh(const RulePlant& plant, const Choices& choices) {
  constexpr std::string_view kName = "kos2021-pid-fh";
  const Areas A = integrating_areas(kName, plant, 5);
  const FilteredPid found = filtered_pid(kName, A, 0, choices);
  const AreaModel m = model(kName, A, choices);
  const double T_CL = 1 / (A[0] * need_pd(kName, found.areas).Kp * choices.positive("KCL"));
  Tuned t = finished(found, found.form, 0);
  t.other_prefilter = higher_reference_filter(m, found.form, found.Tf, T_CL, m.Td > 0 ? 2 : 3);
  t.findings = shown(found.areas, {{"T_dm", m.Td}, {"b_1m", m.b1}, {"a_1m", m.a1}, {"a_2m", m.a2}, {"TCL", T_CL}});
  for (std::size_t i = 1; i <= 5; ++i)
    t.findings.push_back({fmt::format("b_F{}", i), t.other_prefilter->numerator[i]});
  return t;
}

constexpr OptionInfo kWeight = {"b", "weight of the setpoint, 0 (disturbances) .. 1 (setpoints)", "0.5"};
constexpr OptionInfo kSlower = {"KCL", "residence time of the loop against the optimum's, above 1 slower", "1"};
constexpr OptionInfo kTf = {"Tf", "time constant of the filter 1/(Tf s + 1)", ""};
constexpr OptionInfo kKhf = {"KHF", "Kd/Tf, in place of --Tf", ""};

}  // namespace

std::vector<Rule> kos2021_rules() {
  constexpr std::string_view kPlants = "any with one integrator, or a recorded response";
  return {
      {"kos2021-pi",
       "PI",
       kPlants,
       "magnitude optimum with setpoint weight b; b = 1: P",
       "Kos2021 (4.4)-(4.28)",
       {kWeight, kSlower},
       pi},
      {"kos2021-pid",
       "PID",
       kPlants,
       "magnitude optimum with setpoint weights b = c",
       "Kos2021 (5.3)-(5.27)",
       {kWeight, kSlower, kTf, kKhf},
       pid},
      {"kos2021-pd", "PD", kPlants, "magnitude optimum for setpoints, b = 1", "Kos2021 (5.14)", {kTf}, pd},
      {"kos2021-pid-f2",
       "PID",
       kPlants,
       "b = 0 with the second-order reference filter",
       "Kos2021 (5.28)-(5.31)",
       {kTf, kKhf},
       pid_f2},
      {"kos2021-pid-fh",
       "PID",
       kPlants,
       "b = 0 with the reference filter of higher order",
       "Kos2021 (5.32)-(5.43)",
       {kTf,
        kKhf,
        {"KCL", "speed of setpoint responses against the PD loop's, above 1 faster", "3"},
        {"Tdm", "dead time of the model (without it: found from the areas)", ""}},
       pid_fh},
  };
}

}  // namespace portrait::rules
