#include "engine/kernel/measure.h"

#include <algorithm>
#include <vector>

#include "engine/base/check.h"
#include "engine/kernel/margins.h"

namespace portrait::kernel {
namespace {

void measure_all(const Implementation& implementation, const LoopFamily& family, Horizon horizon,
                 const DrawnNoise* noise, std::span<const Setting> settings, std::span<Measured> results) {
  if (noise) return measure_under_noise(implementation, family, settings, *noise, results);
  measure_responses(implementation, family, settings, horizon, results);
}

/// The others are unstable.
void measure_stable(const Implementation& implementation, const LoopFamily& family, Horizon horizon,
                    const DrawnNoise* noise, std::span<const Setting> settings,
                    std::span<const LoopMargins> margins, std::span<Measured> results) {
  std::vector<Setting> stable;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    results[i] = {.status = Status::unstable, .measures = {}, .horizon = 0, .resolved = true};
    if (!margins[i].stable) continue;
    stable.push_back(settings[i]);
    place.push_back(i);
  }
  std::vector<Measured> found(stable.size());
  measure_all(implementation, family, horizon, noise, stable, found);
  for (std::size_t i = 0; i < found.size(); ++i) results[place[i]] = found[i];
}

}  // namespace

void measure(const Implementation& implementation, const LoopFamily& family, Horizon horizon,
             std::span<const Setting> settings, std::span<Measured> results, bool with_margins,
             const DrawnNoise* noise) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  PORTRAIT_CHECK(!noise || noise->horizon() == horizon.dead_times);
  std::vector<LoopMargins> margins(settings.size());
  find_margins(implementation, family, settings, margins, with_margins);
  const bool all_stable =
      std::all_of(margins.begin(), margins.end(), [](const LoopMargins& m) { return m.stable; });
  if (all_stable)
    measure_all(implementation, family, horizon, noise, settings, results);
  else
    measure_stable(implementation, family, horizon, noise, settings, margins, results);
  for (std::size_t i = 0; i < margins.size(); ++i)
    if (margins[i].stable) margins[i].measures.copy_to(results[i].measures);
}

}  // namespace portrait::kernel
