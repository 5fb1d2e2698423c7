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
#include "tools/trace.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait simulate --plant dipdt --kappa 0.24 --delta 0.7 --tau-i 8 --trace responses.csv

Simulates one loop with dead time 1 and plant gain 1, for a unit setpoint step and a
unit input-disturbance step, and prints its measures.)";

/// The line as typed; empty means not given.
struct SimulateArguments {
  std::string plant, kappa, tau_i = "inf", delta, tau_d, tau_1, tau_f, b = "0", c = "0", prefilter,
                            horizon = "auto", sampling, method = "kernel", trace;
  int n = -1;
  bool json = false;
};

/// Without --n a filter constant asks for a first-order filter.
int filter_order(const SimulateArguments& a) {
  if (a.n >= 0) return a.n;
  return a.tau_f.empty() ? 0 : 1;
}

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
  s.kappa = number_argument("--kappa", a.kappa);
  s.tau_i = number_argument("--tau-i", a.tau_i);
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

SettingMeasured measure(const SimulateArguments& a, const Loop& loop, const Horizon& horizon) {
  const Method method = method_argument("--method", a.method);
  const std::optional<double> sampling = sampling_argument("--sampling", a.sampling);
  SettingMeasured measured;
  measure_settings(method, loop.family, horizon, sampling, {&loop.setting, 1}, {&measured, 1});
  if (measured.method != method)
    print_message("note: too stiff for the kernel's panels, measured by the reference method");
  return measured;
}

int simulate(const SimulateArguments& a) {
  const Loop loop = loop_from(a);
  const Horizon horizon = horizon_argument("--horizon", a.horizon);
  if (loop.family.n == 0 && loop.family.prefilter == Prefilter::full && loop.setting.delta > 0)
    print_message(
        "note: with n = 0 the prefilter \"full\" does not cancel the zeros of the setpoint response; \"pi\" does");
  const SettingMeasured measured = measure(a, loop, horizon);
  trace_if_asked(a, loop, horizon);
  const auto all = all_measures();
  const std::vector<Measure> measures(all.begin(), all.end());
  if (a.json) {
    print_json({{"settings", json_settings(loop)},
                {"measures", json_measures(measured.measures, measures)},
                {"status", to_string(measured.status)},
                {"horizon", measured.horizon},
                {"method", method_text(measured.method)}});
    return kDone;
  }
  print_text(loop_text(loop) +
             fmt::format("  {}{}\n\n", to_string(measured.status), horizon_text(horizon, measured)) +
             measures_table(measured.measures, measures, "normalised"));
  return kDone;
}

}  // namespace

void add_simulate(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<SimulateArguments>();
  CLI::App* verb = add_verb(app, "simulate", "one loop: its measures and its responses", kHelp);
  verb->add_option("--plant", a->plant, "dipdt, ipdt or fotd")->required();
  verb->add_option("--kappa", a->kappa, "controller gain")->required();
  verb->add_option("--tau-i", a->tau_i, "integral time Ti/Td; inf: no integral action")->capture_default_str();
  verb->add_option("--delta", a->delta, "derivative gain, kappa tau_d");
  verb->add_option("--tau-d", a->tau_d, "derivative time TD/Td, instead of --delta");
  verb->add_option("--tau-1", a->tau_1, "plant time constant T1/Td (fotd)");
  verb->add_option("--tau-f", a->tau_f, "filter time constant Tf/Td");
  verb->add_option("--n", a->n, "filter order; 0: ideal derivative of the output")->check(CLI::NonNegativeNumber);
  verb->add_option("--prefilter", a->prefilter, "full, pi or none (default: pi with n = 0, else full)");
  verb->add_option("--b", a->b, "prefilter numerator, coefficient of s")->capture_default_str();
  verb->add_option("--c", a->c, "prefilter numerator, coefficient of s^2")->capture_default_str();
  verb->add_option("--horizon", a->horizon, "dead times to simulate, or auto")->capture_default_str();
  verb->add_option("--sampling", a->sampling, "dead times over which measurement noise is held, for noise_gain");
  verb->add_option("--method", a->method, "kernel, as sweeps use it, or reference, its slow judge")
      ->capture_default_str();
  verb->add_option("--trace", a->trace, "write t, y and u of both steps to this CSV file");
  verb->add_flag("--json", a->json, "one JSON object instead of tables");
  verb->callback([a, &invocation] { invocation.exit_code = simulate(*a); });
}

}  // namespace portrait::tools
