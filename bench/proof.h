/// Nothing is timed before its answers are right: every code against the reference, on settings from all over a
/// case.
///
///     engine     IAE and Ms 1e-8, everything else 1e-7 of the signal's total variation; the same status
///     scalar     1e-6, IAE and TV
///     batched    1e-4, IAE and TV; in a case that says so less
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "bench/cases.h"

namespace portrait::bench {

/// Says which code, case and measure, both values, and how to see the right one.
class WrongAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Tolerance {
  double integral;   ///< of IAE and Ms, of their value
  double variation;  ///< of everything else, of TV of the same signal
};

/// The largest error of `measures`, as a part of what the tolerance is of. Throws WrongAnswer for the first of them
/// that is off. `code` is a name for the message.
double prove(const std::string& code, const Loop& loop, const std::vector<Measure>& measures,
             const MeasureRow& found, const MeasureRow& truth, const Tolerance& tolerance);

/// Largest errors of the three codes.
struct Proof {
  double engine = 0, scalar = 0, batched = 0;
};

/// Throws WrongAnswer.
Proof prove_answers(const Case& of);

}  // namespace portrait::bench
