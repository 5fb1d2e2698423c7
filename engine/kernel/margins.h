/// Stability, Ms, Mt and the margins of many loops: the fast path's front door.
///
/// Loops that cross |L| = 1 once, or never, go side by side into packs; the few others are left to engine/loop, which takes
/// any loop.
/// shape     any number of settings of one family
/// accuracy  1e-8 relative against engine/loop/sensitivity.h and margins.h, the count of unstable roots exact:
///           tests/engine/kernel/margins_test.cpp
/// result    a setting's bits do not depend on its neighbours; instruction sets agree to 1e-12
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "engine/kernel/pack.h"
#include "engine/loop/loop.h"
#include "engine/measures/catalogue.h"

namespace portrait::kernel {

inline constexpr std::array kMarginMeasures = {Measure::Ms, Measure::Mt,     Measure::Ms_omega, Measure::Mt_omega,
                                               Measure::GM, Measure::GM_low, Measure::PM,       Measure::DM};

/// One value for each of kMarginMeasures.
class MarginRow {
 public:
  MarginRow() { values_.fill(std::numeric_limits<double>::quiet_NaN()); }
  /// REQUIRES: one of kMarginMeasures.
  double& operator[](Measure measure) { return values_[place(measure)]; }
  double operator[](Measure measure) const { return values_[place(measure)]; }

  void copy_to(MeasureRow& row) const {
    for (std::size_t i = 0; i < values_.size(); ++i) row[kMarginMeasures[i]] = values_[i];
  }

 private:
  static constexpr std::size_t place(Measure measure) {
    std::size_t i = 0;
    while (kMarginMeasures[i] != measure) ++i;
    return i;
  }

  std::array<double, kMarginMeasures.size()> values_;
};

struct LoopMargins {
  bool stable = false;
  MarginRow measures;  ///< of a stable loop; else NaN
};

/// Families of many lags or of gains are searched only for stability where margins are not `wanted`.
/// REQUIRES: settings valid; as many results.
void find_margins(const Implementation& implementation, const LoopFamily& family, std::span<const Setting> settings,
                  std::span<LoopMargins> results, bool wanted = true);

}  // namespace portrait::kernel
