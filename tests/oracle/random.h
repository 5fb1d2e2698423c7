/// Seeded random numbers that are the same on every machine (the standard distributions are not).
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace portrait::oracle {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53;
  }
  /// The logarithm evenly spread. REQUIRES: 0 < low < high.
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  /// 0 .. count - 1.
  int below(int count) { return static_cast<int>(uniform(0, count)); }
  /// True so many times out of one.
  bool chance(double part) { return uniform(0, 1) < part; }

 private:
  std::mt19937_64 bits_;
};

}  // namespace portrait::oracle
