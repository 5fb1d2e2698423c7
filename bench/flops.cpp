#include "bench/flops.h"

#include <algorithm>

#include "engine/kernel/responses.h"

// The kernel with bench/counted_lanes.inl in place of engine/kernel/lanes.inl: that one has been included by the
// time the kernel asks for it, under a name that nobody uses.
#define PORTRAIT_ISA_NAME not_counted
#include "engine/kernel/lanes.inl"
#undef PORTRAIT_ISA_NAME
#define PORTRAIT_ISA_NAME counted
#include "bench/counted_lanes.inl"
#include "engine/kernel/run.inl"

namespace portrait::bench {

double flops_a_setting(const Case& of) {
  constexpr kernel::Implementation kCounted = {"counted", counted::kLanes, counted::run};
  constexpr std::size_t kPack = counted::kLanes, kPacks = 8;
  std::vector<kernel::LaneMeasured> measured(kPack);
  const std::size_t packs = std::min(kPacks, of.settings.size() / kPack);
  const long before = counted::operations;
  for (std::size_t k = 0; k < packs; ++k) {
    const std::size_t first = k * (of.settings.size() / packs);
    kernel::measure_responses(kCounted, of.grid.family, std::span(of.settings).subspan(first, kPack),
                              of.grid.horizon, measured);
  }
  return static_cast<double>(counted::operations - before) / static_cast<double>(packs);
}

}  // namespace portrait::bench
