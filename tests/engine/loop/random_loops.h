/// Loops drawn at random, the same on every machine: all plants, n = 0 .. 4, with and without integral and
/// derivative action, filters from 1e-3 to 10 dead times.
#pragma once

#include <cstdint>
#include <random>

#include "engine/loop/loop.h"

namespace portrait {

class RandomLoops {
 public:
  explicit RandomLoops(std::uint64_t seed) : random_(seed) {}

  double uniform(double from, double to);
  double log_uniform(double from, double to);
  /// 0 .. count - 1
  int index(int count);
  bool chance(double probability) { return uniform(0, 1) < probability; }

  /// Any valid loop, stable or not, retarded or neutral.
  Loop next();
  /// The next one that is stable.
  Loop next_stable();

 private:
  std::mt19937_64 random_;
};

}  // namespace portrait
