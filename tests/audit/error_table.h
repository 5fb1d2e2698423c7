/// The errors of an audit: how they are distributed, and the worst of each kind.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/audit/comparison.h"

namespace portrait::audit {

/// The plant, and whether the controller is a PID or given by gains.
inline constexpr std::array<std::string_view, 5> kFamilyNames = {"dipdt PID", "ipdt PID", "fotd PID", "jotd PID", "gains"};
inline std::size_t family_of(const Loop& loop) {
  return has_gains(loop.family) ? 4 : static_cast<std::size_t>(loop.family.plant);
}

/// Of one family, one method and one kind: the largest error of every loop.
struct Errors {
  std::vector<double> largest;
  Worst worst;

  void take(const Worst& of_loop) {
    largest.push_back(of_loop.error);
    if (of_loop.error > worst.error || worst.command.empty()) worst = of_loop;
  }
  /// The part of loops whose error is not above: 0.5, 0.99. REQUIRES: sorted, not empty.
  double quantile(double part) const {
    return largest[static_cast<std::size_t>(std::ceil(part * static_cast<double>(largest.size()))) - 1];
  }
};

}  // namespace portrait::audit
