#include "bench/codes.h"

#include <algorithm>
#include <string_view>

#include "engine/base/check.h"
#include "engine/isa/dispatch.h"
#include "engine/loop/sensitivity.h"
#include "engine/loop/stability.h"

namespace portrait::bench {

namespace base {
extern const Baseline kBaseline;
}
namespace avx2 {
extern const Baseline kBaseline;
}
namespace avx512 {
extern const Baseline kBaseline;
}

namespace {

const Baseline& baseline_named(std::string_view name) {
  for (const Baseline* baseline : {&base::kBaseline, &avx2::kBaseline, &avx512::kBaseline})
    if (name == baseline->name) return *baseline;
  check_failed(__FILE__, __LINE__, "a baseline for every instruction set of the engine", std::string(name));
}

}  // namespace

void run_engine(const Case& of, std::span<const Setting> settings, MeasureColumns& columns) {
  std::vector<kernel::LaneMeasured> measured(settings.size());
  run_responses(of, settings, measured);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const OpenLoop loop = open_loop({of.grid.family, settings[i]});
    PORTRAIT_CHECK(is_stable(loop));
    measured[i].measures[Measure::Ms] = sensitivity_peak(loop).value;
    columns.set(i, measured[i].status, measured[i].measures);
  }
}

void run_responses(const Case& of, std::span<const Setting> settings, std::span<kernel::LaneMeasured> measured) {
  const kernel::Implementation& implementation = chosen_implementation();
  const auto lanes = static_cast<std::size_t>(implementation.lanes);
  for (std::size_t first = 0; first < settings.size(); first += lanes) {
    const std::size_t count = std::min(lanes, settings.size() - first);
    kernel::measure_responses(implementation, of.grid.family, settings.subspan(first, count), of.grid.horizon,
                              measured.subspan(first, count));
  }
}

void run_step_loop(StepCode code, const Case& of, std::span<const StepSetting> settings,
                   std::span<BothSteps> results) {
  PORTRAIT_CHECK(results.size() >= settings.size());
  const StepTask task{.plant = static_cast<StepPlant>(of.grid.family.plant),
                      .derivative = of.settings.front().delta > 0,
                      .steps = steps(code),
                      .dead_times = static_cast<int>(of.grid.horizon.dead_times)};
  const Baseline& baseline = chosen_baseline();
  const auto run = code == StepCode::scalar ? baseline.scalar : baseline.batched;
  run(task, settings.data(), static_cast<int>(settings.size()), results.data());
}

std::vector<StepSetting> for_step_loop(std::span<const Setting> settings) {
  std::vector<StepSetting> plain;
  for (const Setting& s : settings) plain.push_back({s.kappa, s.tau_i, s.delta, s.tau_1, s.tau_f});
  return plain;
}

const Baseline& chosen_baseline() { return baseline_named(chosen_implementation().name); }

std::vector<const Baseline*> available_baselines() {
  std::vector<const Baseline*> available;
  for (const auto* implementation : available_implementations())
    available.push_back(&baseline_named(implementation->name));
  return available;
}

}  // namespace portrait::bench
