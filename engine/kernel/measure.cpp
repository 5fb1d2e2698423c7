#include "engine/kernel/measure.h"

#include <vector>

#include "engine/base/check.h"
#include "engine/kernel/margins.h"

namespace portrait::kernel {

void measure(const Implementation& implementation, const LoopFamily& family, Horizon horizon,
             std::span<const Setting> settings, std::span<Measured> results) {
  PORTRAIT_CHECK_EQ(settings.size(), results.size());
  std::vector<LoopMargins> margins(settings.size());
  find_margins(implementation, family, settings, margins);
  std::vector<Setting> stable;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    results[i] = {.status = Status::unstable, .measures = {}, .horizon = 0, .resolved = true};
    if (!margins[i].stable) continue;
    stable.push_back(settings[i]);
    place.push_back(i);
  }
  std::vector<Measured> found(stable.size());
  measure_responses(implementation, family, stable, horizon, found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const Measure m : kMarginMeasures) found[i].measures[m] = margins[place[i]].measures[m];
    results[place[i]] = found[i];
  }
}

}  // namespace portrait::kernel
