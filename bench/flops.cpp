#include "bench/flops.h"

#include <algorithm>

#include "engine/kernel/measure.h"

namespace portrait {

namespace counted {
extern const kernel::Implementation kImplementation;
long operations_so_far();
}  // namespace counted

namespace bench {

double flops_a_setting(const Case& of) {
  constexpr std::size_t kPacks = 8;
  const kernel::Implementation& counting = counted::kImplementation;
  const auto lanes = static_cast<std::size_t>(counting.lanes);
  std::vector<kernel::Measured> measured(lanes);
  const std::size_t packs = std::min(kPacks, of.settings.size() / lanes);
  const long before = counted::operations_so_far();
  for (std::size_t k = 0; k < packs; ++k) {
    const std::size_t first = k * (of.settings.size() / packs);
    kernel::measure(counting, of.grid.family, of.grid.horizon, std::span(of.settings).subspan(first, lanes),
                    measured);
  }
  // What is done to a pack is done to each of its settings.
  return static_cast<double>(counted::operations_so_far() - before) / static_cast<double>(packs);
}

}  // namespace bench
}  // namespace portrait
