#include "tools/simulate_noise.h"

#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/words.h"
#include "engine/loop/stability.h"
#include "engine/measures/variation.h"
#include "engine/reference/sampled_loop.h"
#include "tools/arguments.h"

namespace portrait::tools {
namespace {

using reference::Noise;
using reference::NoiseAnswer;
using reference::Response;
using reference::Step;

struct Asked {
  Noise noise;  ///< sampling in normalised time, amplitude in the units of the output
  double horizon;
  int seeds;
  bool sampled;
};

double above_zero(const char* option, const std::string& text) {
  const double value = number_argument(option, text);
  if (!std::isfinite(value) || value <= 0)
    throw InputError(fmt::format("{}: must be finite and above 0 (it is {})", option, text));
  return value;
}

Asked asked(const SimulateArguments& a, const Units& units) {
  if (a.sampling.empty()) throw InputError("--noise needs --sampling: the time over which a value is held");
  if (a.horizon == "auto") throw InputError("--noise needs a fixed --horizon: TV of a noisy signal grows with it");
  Asked found;
  found.noise.amplitude = above_zero("--noise", a.noise);
  found.noise.sampling = above_zero("--sampling", a.sampling) / units.time;
  const std::optional<Noise::Kind> kind = noise_kind_named(a.noise_kind);
  if (!kind)
    throw InputError(fmt::format("--noise-kind: unknown word \"{}\"{}", a.noise_kind,
                                 suggestion(a.noise_kind, {"uniform", "gaussian"})));
  found.noise.kind = *kind;
  found.noise.seed = a.seed, found.seeds = a.seeds, found.sampled = a.sampled;
  found.horizon = horizon_argument("--horizon", a.horizon).dead_times / units.time;
  if (found.horizon / found.noise.sampling >= static_cast<double>(reference::kMostSamples))
    throw InputError(fmt::format("--horizon over --sampling: at most {} samples", reference::kMostSamples));
  return found;
}

/// Whether the dead time is a whole number of sampling times, but for rounding.
bool divides_dead_time(double sampling, double dead_time) {
  const double samples = dead_time / sampling;
  return std::abs(samples - std::round(samples)) < 1e-9 * (1 + samples);
}

/// Mean and standard deviation over seeds of one measure, in the order in which measures are added.
class Statistics {
 public:
  void add(const std::string& name, double value) {
    if (!values_.contains(name)) names_.push_back(name);
    values_[name].push_back(value);
  }
  Json json() const {
    Json json = Json::object();
    for (const std::string& name : names_) json[name] = of(values_.at(name));
    return json;
  }

 private:
  static Json of(const std::vector<double>& values) {
    const MeanAndSpread found = mean_and_spread(values);
    return {{"mean", json_number(found.mean)}, {"spread", json_number(found.spread)}};
  }
  std::vector<std::string> names_;
  std::map<std::string, std::vector<double>> values_;
};

struct Scales {
  double y, u;  ///< from normalised to the units of the line
};

void add_signal(const char* signal, std::vector<double> x, double at_rest, double factor, Statistics& into) {
  x.insert(x.begin(), 0.0);
  into.add(fmt::format("TV_{}", signal), factor * total_variation(x));
  for (int m = 0; m <= 8; ++m)
    into.add(fmt::format("TV{}_{}", m, signal), factor * std::max(0.0, shape_deviation(x, at_rest, m)));
}

/// Signals of size one step, normalised, with noise whose size is told in parts of that step.
using NoisySignals = std::function<reference::Sampled(const Noise&)>;

Json over_seeds(const Asked& ask, double noise_per_step, const reference::StepResponse& step, Scales scales,
                const NoisySignals& signals) {
  Statistics statistics;
  for (int i = 0; i < ask.seeds; ++i) {
    Noise noise = ask.noise;
    noise.seed += static_cast<std::uint64_t>(i), noise.amplitude *= noise_per_step;
    reference::Sampled found = signals(noise);
    add_signal("u", std::move(found.u), step.at_rest.u, scales.u, statistics);
    add_signal("y", std::move(found.y), step.at_rest.y, scales.y, statistics);
  }
  return statistics.json();
}

reference::Sampled with_noise(const reference::StepResponse& step, const NoiseAnswer& answer, const Noise& noise) {
  reference::Sampled found = reference::sampled(step, noise.sampling, answer.samples());
  const std::vector<double> u = answer.u(noise), y = answer.y(noise);
  for (std::size_t k = 0; k < u.size(); ++k) found.u[k] += u[k], found.y[k] += y[k];
  return found;
}

/// sigma of u over sigma of the noise, over the second half of the horizon.
Json sigma_json(const Asked& ask, const NoiseAnswer& answer, double gain) {
  Statistics statistics;
  for (int i = 0; i < ask.seeds; ++i) {
    Noise noise = ask.noise;
    noise.seed += static_cast<std::uint64_t>(i);
    const std::vector<double> u = answer.u(noise);
    double of_u = 0, of_n = 0;
    for (std::size_t k = u.size() / 2; k < u.size(); ++k) {
      const double n = reference::noise_value(noise, k);
      of_u += u[k] * u[k], of_n += n * n;
    }
    statistics.add("simulated", std::sqrt(of_u / of_n) / gain);
  }
  Json json = statistics.json();
  json["expected"] = answer.u_sigma_ratio() / gain;
  return json;
}

}  // namespace

Json noise_report(const SimulateArguments& a, const NormalisedLoop& inside, const Sizes& sizes) {
  const GeneralController& c = inside.loop.controller;
  if (degree(c.on_output) > degree(c.denominator))
    throw InputError("--noise: the ideal derivative makes an impulse of every value; give the controller a filter");
  if (!is_stable(open_loop(inside.loop))) throw InputError("--noise: the loop is unstable");
  const Asked ask = asked(a, inside.units);
  const Response r = reference::simulate(inside.loop, Horizon::until_settled(), {}, reference::kAllSteps);
  const NoiseAnswer answer(r, ask.noise.sampling, ask.horizon);
  const double gain = std::abs(inside.units.gain);
  Json json{{"kind", a.noise_kind},
            {"amplitude", ask.noise.amplitude},
            {"sampling", ask.noise.sampling * inside.units.time},
            {"controller", ask.sampled ? "sampled" : "continuous"},
            {"seed", a.seed},
            {"seeds", ask.seeds},
            {"samples", answer.samples()},
            {"sampling_divides_dead_time", divides_dead_time(ask.noise.sampling, inside.loop.plant.dead_time)}};
  json["noise_gain"] = json_number(reference::noise_gain(r, ask.noise.sampling) / gain);
  json["sigma_ratio"] = sigma_json(ask, answer, gain);
  for (const Step step : reference::kUsualSteps) {
    const bool of_d = step == reference::kDisturbance;
    const double size = std::abs(sizes[step]);
    const Scales scales{size * (of_d ? gain : 1), size * (of_d ? 1 : 1 / gain)};
    const double noise_per_step = 1 / scales.y;
    const auto signals = [&](const Noise& noise) {
      if (ask.sampled) return reference::simulate_sampled(inside.loop, step, noise.sampling, ask.horizon, noise);
      return with_noise(r.steps[step], answer, noise);
    };
    json[of_d ? "d" : "w"] = over_seeds(ask, noise_per_step, r.steps[step], scales, signals);
  }
  return json;
}

std::string noise_text(const Json& report) {
  const auto number = [](const Json& json) {
    return json.is_null() ? std::string("-") : short_number(json.get<double>());
  };
  std::string text =
      fmt::format("\n  {} noise of {} held over {}, {} controller, {} seeds from {}, {} samples\n",
                  report["kind"].get<std::string>(), number(report["amplitude"]), number(report["sampling"]),
                  report["controller"].get<std::string>(), report["seeds"].get<int>(),
                  report["seed"].get<std::uint64_t>(), report["samples"].get<std::size_t>());
  if (!report["sampling_divides_dead_time"].get<bool>())
    text +=
        "  the sampling time does not divide the dead time: nothing is rounded, the delayed output is exact in "
        "between\n";
  const Json& sigma = report["sigma_ratio"];
  text += fmt::format("  sigma_u/sigma_n {} simulated, {} expected; noise_gain {}\n",
                      number(sigma["simulated"]["mean"]), number(sigma["expected"]), number(report["noise_gain"]));
  text += fmt::format("  {:<12} {:>14} {:>14} {:>14} {:>14}\n", "", "setpoint", "spread", "disturbance", "spread");
  for (const auto& [name, of_w] : report["w"].items()) {
    const Json& of_d = report["d"][name];
    text += fmt::format("  {:<12} {:>14} {:>14} {:>14} {:>14}\n", name, number(of_w["mean"]),
                        number(of_w["spread"]), number(of_d["mean"]), number(of_d["spread"]));
  }
  return text;
}

}  // namespace portrait::tools
