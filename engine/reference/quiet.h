/// Watches a running simulation and tells when the rest can no longer matter.
///
/// Over the last half of the run so far, [T/2, T], the largest deviations from rest in the two quarters, m1
/// and m2, give the decay per quarter, rho = m2/m1. A tail that goes on so contributes at most (T/4) m2
/// rho/(1 - rho) to the integral of the deviation; the run is quiet when that is below 1e-10 of the integral
/// so far, for y and u and both steps.
/// accuracy  an estimate from the decay seen, not a bound; a mode that is slower and still hidden escapes it
#pragma once

#include <array>
#include <vector>

#include "engine/reference/response.h"

namespace portrait::reference {

class QuietWatch {
 public:
  /// `response` grows while it is watched, by `panels` pieces an interval.
  QuietWatch(const Response& response, std::size_t panels) : response_(response), panels_(panels) {}

  /// Asks after each interval; looks at the first, second, ... multiple of 8 dead times and after every
  /// further 10 %.
  bool is_quiet();

 private:
  void take_in_new_intervals();
  std::size_t pieces_so_far() const;

  const Response& response_;
  std::size_t panels_;
  std::array<std::vector<double>, 2 * kSteps> deviations_;  ///< largest of an interval, by signal
  std::size_t next_look_ = 8;
};

}  // namespace portrait::reference
