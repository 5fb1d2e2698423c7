/// portrait simulate: one loop, its measures, and on request its responses.

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/loop/parameters.h"
#include "engine/loop/stability.h"
#include "engine/reference/response.h"
#include "engine/sweep/method.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/output.h"
#include "tools/simulate_arguments.h"
#include "tools/simulate_options.h"
#include "tools/trace.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait simulate --plant dipdt --kappa 0.24 --delta 0.7 --tau-i 8 --trace responses.csv

  portrait simulate --plant tf:34/13.5,54.25,55,1 --pid standard:Kc=0.78,Ti=5.35
  portrait simulate --plant jotd --j 4 --tau-j 2 --gains 0.4,1.3,1.0 --n 1 --tau-f 0.1

Simulates one loop for a unit setpoint step and a unit input-disturbance step and prints its
measures. Beyond the normalised families (dead time 1, plant gain 1) a trace has a unit step of
the output too.)";

void set_derivative(const SimulateArguments& a, Setting& setting) {
  if (!a.delta.empty() && !a.tau_d.empty())
    throw InputError("--delta and --tau-d say the same: give one of the two");
  if (!a.delta.empty()) set(setting, Parameter::delta, number_argument("--delta", a.delta));
  if (!a.tau_d.empty()) set(setting, Parameter::tau_d, number_argument("--tau-d", a.tau_d));
}

/// A number that only some families have: an error where it would be ignored.
double family_number(const char* option, const std::string& text, bool belongs, const char* needs) {
  if (text.empty()) {
    if (belongs) throw InputError(fmt::format("{} is missing: {}", option, needs));
    return 0;
  }
  if (!belongs) throw InputError(fmt::format("{} has no place here: {}", option, needs));
  return number_argument(option, text);
}

Loop loop_from(const SimulateArguments& a) {
  Loop loop;
  loop.family.plant = plant_family_argument("--plant", a.plant);
  loop.family.n = filter_order(a);
  loop.family.prefilter =
      a.prefilter.empty() ? usual_prefilter(loop.family.n) : prefilter_argument("--prefilter", a.prefilter);
  Setting& s = loop.setting;
  if (a.kappa.empty()) throw InputError("--kappa is required");
  s.kappa = number_argument("--kappa", a.kappa);
  s.tau_i = a.tau_i.empty() ? kInf : number_argument("--tau-i", a.tau_i);
  set_derivative(a, s);
  s.tau_1 = family_number("--tau-1", a.tau_1, loop.family.plant == Plant::fotd, "fotd has one, T1/Td");
  s.tau_f = family_number("--tau-f", a.tau_f, loop.family.n >= 1, "a filter of order --n 1 or more has one, Tf/Td");
  s.b = number_argument("--b", a.b);
  s.c = number_argument("--c", a.c);
  if (const auto reason = why_invalid(loop)) throw InputError(*reason);
  return loop;
}

std::string loop_text(const Loop& loop) {
  const std::string filter = loop.family.n == 0 ? "ideal derivative of the output (n = 0)"
                                                : fmt::format("filter of order {}", loop.family.n);
  return fmt::format("{}, {}, prefilter {}\n  {}\n", to_string(loop.family.plant), filter,
                     to_string(loop.family.prefilter), setting_text(loop));
}

std::string horizon_text(const Horizon& horizon, const SettingMeasured& measured) {
  if (measured.status == Status::unstable) return "";
  return fmt::format(", {} dead times{}", short_number(measured.horizon), horizon.automatic ? " (auto)" : "");
}

/// A trace may be wanted of an unstable loop too, whose end nothing but the caller can choose. The responses are those of the
/// reference, which keeps them; the kernel keeps measures.
void trace_if_asked(const SimulateArguments& a, const Loop& loop, const Horizon& horizon) {
  if (a.trace.empty()) return;
  const bool stable = is_stable(open_loop(loop));
  if (!stable && horizon.automatic)
    throw InputError("--trace of an unstable loop needs a fixed --horizon: its responses never settle");
  const reference::Response response = reference::simulate(loop, horizon);
  write_trace(response, a.trace);
  print_message(fmt::format("responses over {} dead times written to {}{}", short_number(response.horizon), a.trace,
                            stable ? "" : " (the loop is unstable)"));
}

Method method_asked_for(const SimulateArguments& a) {
  return a.method.empty() ? Method::kernel : method_argument("--method", a.method);
}

/// What the kernel does not measure, by the reference.
void add_further_measures(const Loop& loop, const Horizon& horizon, SettingMeasured& measured) {
  SettingMeasured further;
  measure_settings(Method::reference, loop.family, horizon, {.output_step = true}, {&loop.setting, 1},
                   {&further, 1});
  for (const Measure m : all_measures())
    if (!is_standard(m)) measured.measures[m] = further.measures[m];
}

SettingMeasured measure(const SimulateArguments& a, const Loop& loop, const Horizon& horizon) {
  const Method method = method_asked_for(a);
  const std::optional<double> sampling = sampling_argument("--sampling", a.sampling);
  SettingMeasured measured;
  measure_settings(method, loop.family, horizon, {.sampling = sampling, .output_step = true}, {&loop.setting, 1},
                   {&measured, 1});
  if (method_of(measured) != method)
    print_message("note: too stiff for the kernel's panels, measured by the reference method");
  if (method_of(measured) == Method::kernel && measured.status != Status::unstable)
    add_further_measures(loop, horizon, measured);
  return measured;
}

int simulate(const SimulateArguments& a) {
  if (is_general(a)) return simulate_general(a);
  if (!plant_named(a.plant))
    throw InputError(fmt::format("--plant: unknown plant \"{}\"{}", a.plant,
                                 suggestion(a.plant, {"dipdt", "ipdt", "fotd", "jotd", "tf:NUM/DEN"})));
  if (a.j != 0) throw InputError("--j has no place here: jotd has it");
  const Loop loop = loop_from(a);
  const Horizon horizon = horizon_argument("--horizon", a.horizon);
  if (loop.family.n == 0 && loop.family.prefilter == Prefilter::full && loop.setting.delta > 0)
    print_message(
        "note: with n = 0 the prefilter \"full\" does not cancel the zeros of the setpoint response; \"pi\" does");
  const SettingMeasured measured = measure(a, loop, horizon);
  trace_if_asked(a, loop, horizon);
  const std::vector<Measure> measures = measures_of_one_run();
  if (a.json) {
    print_json({{"settings", json_settings(loop)},
                {"measures", json_measures(measured.measures, measures)},
                {"status", to_string(measured.status)},
                {"horizon", measured.horizon},
                {"method", method_text(method_of(measured))}});
    return kDone;
  }
  print_text(loop_text(loop) +
             fmt::format("  {}{}\n\n", to_string(measured.status), horizon_text(horizon, measured)) +
             measures_table(measured.measures, measures, "normalised"));
  return kDone;
}

/// Loops beyond the normalised families, in any consistent set of units.
void add_general_options(CLI::App& verb, SimulateArguments& a) {
  verb.add_option("--step", a.step, "sizes of the steps, w=,d=,o= (default: 1)");
  verb.add_option("--noise", a.noise, "amplitude of measurement noise, with --sampling and a fixed --horizon");
  verb.add_option("--noise-kind", a.noise_kind, "uniform in +-amplitude, or gaussian with that sigma")
      ->capture_default_str();
  verb.add_option("--seed", a.seed, "of the noise")->capture_default_str();
  verb.add_option("--seeds", a.seeds, "this many seeds from it, for mean and spread")->check(CLI::Range(1, 10000));
  verb.add_flag("--sampled", a.sampled, "the controller too runs at the sampling time and holds u");
  verb.add_option("--time-unit", a.time_unit, "unit of time of a plant without dead time, for the normalisation");
}

}  // namespace

void add_simulate(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<SimulateArguments>();
  CLI::App* verb = add_verb(app, "simulate", "one loop: its measures and its responses", kHelp);
  add_loop_options(*verb, *a);
  verb->add_option("--horizon", a->horizon, "dead times to simulate, or auto")->capture_default_str();
  verb->add_option("--sampling", a->sampling, "dead times over which measurement noise is held, for noise_gain");
  verb->add_option("--method", a->method, "kernel, as sweeps use it (default), or reference, its slow judge");
  verb->add_option("--trace", a->trace, "write t, y and u of the steps to this CSV file");
  add_general_options(*verb, *a);
  verb->add_flag("--json", a->json, "one JSON object instead of tables");
  verb->callback([a, &invocation] { invocation.exit_code = simulate(*a); });
}

}  // namespace portrait::tools
