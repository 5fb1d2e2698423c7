#include "bench/codes.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "engine/base/check.h"
#include "engine/isa/dispatch.h"
#include "engine/sweep/method.h"
#include "engine/sweep/tile_queue.h"

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

/// What a worker of a sweep measures at a time.
constexpr std::size_t kSlice = TileQueue::kSliceSettings;

const Baseline& baseline_named(std::string_view name) {
  for (const Baseline* baseline : {&base::kBaseline, &avx2::kBaseline, &avx512::kBaseline})
    if (name == baseline->name) return *baseline;
  check_failed(__FILE__, __LINE__, "a baseline for every instruction set of the engine", std::string(name));
}

}  // namespace

void run_engine(const Case& of, std::span<const Setting> settings, MeasureColumns& columns) {
  std::vector<SettingMeasured> measured(kSlice);
  for (std::size_t first = 0; first < settings.size(); first += kSlice) {
    const std::size_t count = std::min(kSlice, settings.size() - first);
    measure_settings(Method::kernel, of.grid.family, of.grid.horizon, {}, settings.subspan(first, count),
                     std::span(measured).first(count));
    const auto found = std::span<const SettingMeasured>(measured).first(count);
    for (const SettingMeasured& m : found)
      if (method_of(m) != Method::kernel) throw std::runtime_error(of.name + ": left to the reference method");
    columns.set_all(first, found);
  }
}

void run_responses(const Case& of, std::span<const Setting> settings, std::span<kernel::Measured> measured) {
  for (std::size_t first = 0; first < settings.size(); first += kSlice) {
    const std::size_t count = std::min(kSlice, settings.size() - first);
    kernel::measure_responses(chosen_implementation(), of.grid.family, settings.subspan(first, count),
                              of.grid.horizon, measured.subspan(first, count));
  }
}

void run_margins(const Case& of, std::span<const Setting> settings, std::span<kernel::LoopMargins> found) {
  for (std::size_t first = 0; first < settings.size(); first += kSlice) {
    const std::size_t count = std::min(kSlice, settings.size() - first);
    kernel::find_margins(chosen_implementation(), of.grid.family, settings.subspan(first, count),
                         found.subspan(first, count));
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
