/// The two ways to measure settings: the kernel, which everything uses, and the reference, its judge.
///
/// shape     any number of settings of one family
/// result    a setting's bits depend on the setting, the method and the instruction set, on nothing beside them
/// errors    std::runtime_error with the command that reproduces the setting
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kernel/measure.h"
#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"

namespace portrait {

enum class Method {
  kernel,     ///< engine/kernel, many settings at a time
  reference,  ///< engine/reference, one setting after the other
};

inline constexpr std::array<std::string_view, 2> kMethodNames = {"kernel", "reference"};
constexpr std::string_view to_string(Method method) { return kMethodNames[static_cast<std::size_t>(method)]; }
std::optional<Method> method_named(std::string_view name);

/// For the record: "kernel, avx512" or "reference". Throws InputError where PORTRAIT_ISA asks for what is not there.
std::string method_text(Method method);

/// Its measures are all NaN when unstable. What the kernel's finest panels cannot resolve the reference has measured.
using SettingMeasured = kernel::Measured;
constexpr Method method_of(const SettingMeasured& measured) {
  return measured.resolved ? Method::kernel : Method::reference;
}

/// Why this method does not measure this, and which does ("the kernel does not measure TV3_uw: ..."), or nothing.
std::optional<std::string> why_not_measured(Method method, std::span<const Measure> measures);

/// The kernel where it measures all of these, else the reference.
Method method_for(std::span<const Measure> measures);

/// What is measured only where it is asked for; its measures are NaN otherwise.
struct Extras {
  std::optional<double> sampling = std::nullopt;  ///< dead times over which noise is held, for noise_gain
  std::shared_ptr<const kernel::DrawnNoise> noise =
      nullptr;                                    ///< for the noisy measures; of the horizon that is asked for
  bool output_step = false;                       ///< the measures of the step o
  bool margins =
      true;  ///< Ms to DM; without them a family whose margins are searched one by one is many times faster
};
/// What these measures need of them.
Extras extras_for(std::span<const Measure> measures, std::optional<double> sampling,
                  const std::optional<NoiseTrials>& noise, Horizon horizon);

/// The controller passes on no impulses: its noise can be simulated.
bool is_proper(const Loop& loop);

/// REQUIRES: settings valid; as many results.
void measure_settings(Method method, const LoopFamily& family, Horizon horizon, const Extras& extras,
                      std::span<const Setting> settings, std::span<SettingMeasured> results);

}  // namespace portrait
