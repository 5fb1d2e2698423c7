/// How finely a loop's responses are cut into panels, so that series of the kernel's degree hold them.
///
/// A fast time constant T (filter, plant, prefilter) leaves a layer e^{-t/T} after every dead time, weaker by the loop's gain
/// |L(j/T)| each time around. Panels graded towards the start of a dead time hold the layers while they matter; after that
/// a dead time is one panel. What is left then loses its fast parts the same way, |L(j omega)| each time around, and from
/// `smooth_from` on series of a lower degree hold it.
///
/// The guess depends on the setting alone; whether it was good enough is seen in the last
/// coefficients of the run, and `finer` gives what to try next.
#pragma once

#include <optional>

#include "engine/kernel/pack.h"
#include "engine/loop/loop.h"

namespace portrait::kernel {

/// The kind of plant that computes a family: of its own where there is one.
constexpr PlantKind plant_kind(const LoopFamily& family) {
  if (has_gains(family)) return PlantKind::cascade;
  switch (family.plant) {
    case Plant::dipdt:
      return PlantKind::dipdt;
    case Plant::ipdt:
      return PlantKind::ipdt;
    case Plant::fotd:
      return PlantKind::fotd;
    case Plant::jotd:
      return family.j == 1 ? PlantKind::fotd : PlantKind::cascade;
  }
  return PlantKind::cascade;
}

struct Resolution {
  Mesh mesh{};
  int layered_intervals = 0;
  int smooth_from = 0;
  int attempt = 0;
};

/// `fastest`: the smallest time constant of the loop, inf for none.
Resolution first_resolution(const Loop& loop, double fastest);

/// The next finer one; none beyond the finest.
std::optional<Resolution> finer(const Resolution& resolution);

/// The same without series of a lower degree.
Resolution without_smooth_part(const Resolution& resolution);

}  // namespace portrait::kernel
