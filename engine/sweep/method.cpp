#include "engine/sweep/method.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/isa/dispatch.h"
#include "engine/kernel/margins.h"
#include "engine/loop/noise_gain.h"
#include "engine/loop/parameters.h"
#include "engine/reference/measure.h"
#include "engine/reference/noise.h"

namespace portrait {
namespace {

SettingMeasured measured_by_reference(const Loop& loop, Horizon horizon, const Extras& extras) try {
  const auto steps = std::span(reference::kAllSteps).first(extras.output_step && is_proper(loop) ? 3 : 2);
  const reference::Measured m = reference::measure(loop, horizon, {}, extras.sampling, steps);
  SettingMeasured found{.status = m.status, .measures = m.measures, .horizon = m.horizon, .resolved = false};
  if (extras.noise && m.status != Status::unstable && is_proper(loop))
    reference::measure_noise(loop, extras.noise->trials(), extras.noise->horizon(), found.measures);
  return found;
} catch (const std::exception& failure) {
  throw std::runtime_error(fmt::format("{}\nreproduce: {}", failure.what(), simulate_command(loop)));
}

void measure_by_kernel(const LoopFamily& family, Horizon horizon, const Extras& extras,
                       std::span<const Setting> settings, std::span<SettingMeasured> results) {
  kernel::measure(chosen_implementation(), family, horizon, settings, results, extras.margins, extras.noise.get());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Loop loop{family, settings[i]};
    if (!results[i].resolved)
      results[i] = measured_by_reference(loop, horizon, extras);
    else if (extras.sampling && results[i].status != Status::unstable)
      results[i].measures[Measure::noise_gain] = noise_gain(loop, *extras.sampling);
  }
}

}  // namespace

bool is_proper(const Loop& loop) { return loop.family.n > 0 || loop.setting.delta == 0; }

std::optional<Method> method_named(std::string_view name) {
  const auto found = std::find(kMethodNames.begin(), kMethodNames.end(), name);
  if (found == kMethodNames.end()) return std::nullopt;
  return static_cast<Method>(found - kMethodNames.begin());
}

std::string method_text(Method method) {
  if (method == Method::reference) return "reference";
  return fmt::format("kernel, {}", chosen_implementation().name);
}

Method method_for(std::span<const Measure> measures) {
  return why_not_measured(Method::kernel, measures) ? Method::reference : Method::kernel;
}

Extras extras_for(std::span<const Measure> measures, std::optional<double> sampling,
                  const std::optional<NoiseTrials>& noise, Horizon horizon) {
  Extras extras{.margins = false};
  for (const Measure m : measures) {
    const auto& of_margins = kernel::kMarginMeasures;
    if (std::find(of_margins.begin(), of_margins.end(), m) != of_margins.end()) extras.margins = true;
    if (m == Measure::noise_gain) extras.sampling = sampling;
    if (info(m).step == 'o') extras.output_step = true;
    if (is_noisy(m) && noise && !extras.noise)
      extras.noise = std::make_shared<const kernel::DrawnNoise>(*noise, horizon.dead_times);
  }
  return extras;
}

void measure_settings(Method method, const LoopFamily& family, Horizon horizon, const Extras& extras,
                      std::span<const Setting> settings, std::span<SettingMeasured> results) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  if (method == Method::kernel) return measure_by_kernel(family, horizon, extras, settings, results);
  for (std::size_t i = 0; i < settings.size(); ++i)
    results[i] = measured_by_reference({family, settings[i]}, horizon, extras);
}

std::optional<std::string> why_not_measured(Method method, std::span<const Measure> measures) {
  for (const Measure m : measures)
    if (method == Method::kernel && !is_standard(m) && !is_noisy(m))
      return fmt::format("the kernel does not measure {}: --method reference does, one setting after the other",
                         to_string(m));
  return std::nullopt;
}

}  // namespace portrait
