/// How long a response is watched.
#pragma once

namespace portrait {

/// A fixed horizon gives the truncated integrals of the papers; `automatic` runs until the responses have
/// settled so far that the rest cannot matter, or to the cap.
struct Horizon {
  double dead_times = 0;  ///< fixed: above 0
  bool automatic = false;

  static constexpr Horizon fixed(double dead_times) { return {dead_times, false}; }
  static constexpr Horizon until_settled() { return {0, true}; }
};

/// The longest automatic horizon: a loop that is not quiet by then is reported as not settled.
inline constexpr double kHorizonCap = 10'000;

}  // namespace portrait
