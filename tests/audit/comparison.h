/// One loop by the kernel and by the reference, against independent means.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"
#include "engine/sweep/method.h"
#include "tests/audit/independent.h"

namespace portrait::audit {

/// Measures that keep the same promise.
enum class Kind { integrals, variations, margins };
inline constexpr std::array<std::string_view, 3> kKindNames = {"integrals", "variations", "margins"};

/// What the kernel promises (engine/kernel/measure.h, responses.h): integrals as parts of themselves, variations and peaks as
/// parts of the signal's variation, margins as parts of themselves; below 1e-3 all are absolute.
inline constexpr std::array<double, 3> kAllowed = {1e-8, 1e-7, 1e-7};

inline constexpr std::size_t kKinds = kKindNames.size(), kMethods = kMethodNames.size();

struct Worst {
  double error = 0, found = 0, truth = 0;
  Measure measure = Measure::IAE_w;
  std::uint64_t number = 0;
  std::string command;
};

using WorstOfKinds = std::array<Worst, kKinds>;

struct LoopErrors {
  std::array<SettingMeasured, kMethods> measured;
  std::array<WorstOfKinds, kMethods> worst;
  Independent truth;
};

/// Measures the loop three times; what the raster of the independent means missed is looked at again, four times finer.
/// REQUIRES: the loop is valid and stable.
LoopErrors audited(const Loop& loop, int dead_times);

/// The worst of each kind in `found`.
WorstOfKinds compared(const MeasureRow& found, const MeasureRow& truth);
bool exceeds(const WorstOfKinds& worst);

}  // namespace portrait::audit
