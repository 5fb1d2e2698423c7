/// portrait simulate of a loop beyond the normalised families: measured normalised, told in the units of the line.

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/loop/stability.h"
#include "engine/reference/measure.h"
#include "tools/arguments.h"
#include "tools/exit_codes.h"
#include "tools/general_arguments.h"
#include "tools/general_loop_arguments.h"
#include "tools/output.h"
#include "tools/simulate_arguments.h"
#include "tools/simulate_noise.h"
#include "tools/trace.h"

namespace portrait::tools {
namespace {

using reference::Measured;

Sizes sizes_of(const SimulateArguments& a) {
  const std::vector<double> found = named_numbers_argument("--step", a.step, {"w", "d", "o"}, 1);
  for (const double size : found)
    if (!std::isfinite(size) || size == 0) throw InputError("--step: a size must be finite and not 0");
  return {found[0], found[1], found[2]};
}

std::optional<double> time_unit(const SimulateArguments& a, const GeneralLoop& loop) {
  if (a.time_unit.empty()) return std::nullopt;
  if (loop.plant.dead_time > 0)
    throw InputError("--time-unit belongs to plants without dead time: else the dead time is the unit");
  const double unit = number_argument("--time-unit", a.time_unit);
  if (!std::isfinite(unit) || unit <= 0) throw InputError("--time-unit: must be finite and above 0");
  return unit;
}

/// Measures grow with the size of the step, squared errors with its square.
double size_factor(Measure m, const Sizes& sizes) {
  const MeasureInfo& of = info(m);
  if (of.step == '-' || of.unit == Unit::one) return 1;
  const double size = std::abs(sizes[of.step == 'w' ? 0 : of.step == 'd' ? 1 : 2]);
  return of.unit == Unit::output2_time || of.unit == Unit::output2_time2 ? size * size : size;
}

/// A response to a normalised unit step, in the units of the line and for the size of the step.
void scale_response(reference::Response& response, const Units& units, const Sizes& sizes) {
  for (std::size_t step = 0; step < reference::kSteps; ++step) {
    const bool of_d = step == reference::kDisturbance;
    const double y = sizes[step] * (of_d ? units.gain : 1), u = sizes[step] * (of_d ? 1 : 1 / units.gain);
    for (reference::Piece& piece : response.steps[step].pieces) {
      piece.start *= units.time, piece.length *= units.time;
      piece.y *= y, piece.u *= u;
    }
  }
  response.horizon *= units.time;
}

std::string polynomial_text(const Polynomial& p) {
  std::string text;
  for (std::size_t i = p.size(); i-- > 0;) text += (text.empty() ? "" : ",") + number_text(p[i]);
  return text;
}

std::string fraction_text(const Polynomial& N, const std::vector<Polynomial>& D) {
  return fmt::format("tf:{}/{}", polynomial_text(N), polynomial_text(written_out(D)));
}

Json json_loop(const GeneralLoop& loop) {
  const GeneralController& c = loop.controller;
  Json json{{"plant", fraction_text(loop.plant.rational.numerator, loop.plant.rational.denominator)},
            {"Td", loop.plant.dead_time},
            {"controller", fraction_text(c.on_output, c.denominator)}};
  if (c.on_setpoint != c.on_output) json["controller_of_setpoint"] = fraction_text(c.on_setpoint, c.denominator);
  json["prefilter"] = fraction_text(c.prefilter.numerator, c.prefilter.denominator);
  return json;
}

std::string units_text(const GeneralLoop& loop, const Units& units) {
  const char* what = loop.plant.dead_time > 0 ? "the dead time" : "chosen or given, there is no dead time";
  return fmt::format("  normalised by time {} ({}) and plant gain {}; all below in the units of the line\n",
                     short_number(units.time), what, short_number(units.gain));
}

void trace(const SimulateArguments& a, const NormalisedLoop& inside, Horizon horizon, const Sizes& sizes) {
  if (!is_stable(open_loop(inside.loop)) && horizon.automatic)
    throw InputError("--trace of an unstable loop needs a fixed --horizon: its responses never settle");
  const bool with_output = degree(inside.loop.controller.on_output) <= degree(inside.loop.controller.denominator);
  const auto steps = std::span(reference::kAllSteps).first(with_output ? 3 : 2);
  reference::Response response = reference::simulate(inside.loop, horizon, {}, steps);
  scale_response(response, inside.units, sizes);
  write_trace(response, a.trace);
  print_message(
      fmt::format("responses over {} units of time written to {}", short_number(response.horizon), a.trace));
}

/// A time of the line's units.
double noise_gain_at(const SimulateArguments& a, const NormalisedLoop& inside) {
  const double sampling = number_argument("--sampling", a.sampling);
  if (!std::isfinite(sampling) || sampling <= 0) throw InputError("--sampling: must be finite and above 0");
  const reference::Response r =
      reference::simulate(inside.loop, Horizon::until_settled(), {}, std::span(reference::kAllSteps).last(1));
  return reference::noise_gain(r, sampling / inside.units.time);
}

}  // namespace

bool is_general(const SimulateArguments& a) {
  const bool options =
      !(a.K.empty() && a.Td.empty() && a.tau_j.empty() && a.pid.empty() && a.gains.empty() &&
        a.controller.empty() && a.weights.empty() && a.time_unit.empty() && a.step.empty() && a.noise.empty());
  return options || is_transfer_function(a.plant) || a.plant == "jotd" || is_transfer_function(a.prefilter);
}

int simulate_general(const SimulateArguments& a) {
  if (a.method == "kernel")
    throw InputError(
        "--method kernel: here only of dipdt, ipdt and fotd; jotd and gains it sweeps from a grid file; leave "
        "--method out");
  const GeneralLoop loop = general_loop_argument(a);
  const Sizes sizes = sizes_of(a);
  const NormalisedLoop inside = normalised(loop, time_unit(a, loop));
  Horizon horizon = horizon_argument("--horizon", a.horizon);
  horizon.dead_times /= inside.units.time;
  const bool with_output = degree(loop.controller.on_output) <= degree(loop.controller.denominator);
  const auto steps = std::span(reference::kAllSteps).first(with_output ? 3 : 2);
  Measured measured = reference::measure(inside.loop, horizon, {}, steps);
  if (!a.sampling.empty() && with_output && measured.status != Status::unstable)
    measured.measures[Measure::noise_gain] = noise_gain_at(a, inside);
  for (const Measure m : all_measures()) measured.measures[m] *= scale(m, inside.units) * size_factor(m, sizes);
  measured.horizon *= inside.units.time;
  if (!a.trace.empty()) trace(a, inside, horizon, sizes);

  const std::vector<Measure> measures = measures_of_one_run();
  const Json noise = a.noise.empty() ? Json() : noise_report(a, inside, sizes);
  if (a.json) {
    Json json{{"settings", json_loop(loop)},
              {"measures", json_measures(measured.measures, measures)},
              {"status", to_string(measured.status)},
              {"horizon", measured.horizon},
              {"units", {{"time", inside.units.time}, {"gain", inside.units.gain}}},
              {"method", "reference"}};
    if (!noise.is_null()) json["noise"] = noise;
    print_json(json);
    return kDone;
  }
  const Json described = json_loop(loop);
  std::string text;
  for (const auto& [name, what] : described.items())
    text += fmt::format("{:<24} {}\n", name, what.is_string() ? what.get<std::string>() : what.dump());
  print_text(text + units_text(loop, inside.units) +
             fmt::format("  {}{}\n\n", to_string(measured.status),
                         measured.horizon > 0 ? fmt::format(", horizon {}", short_number(measured.horizon)) : "") +
             measures_table(measured.measures, measures, "units of the line") +
             (noise.is_null() ? "" : noise_text(noise)));
  return kDone;
}

}  // namespace portrait::tools
