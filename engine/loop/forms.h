/// The three ways of writing one PID controller, and the way between them.
///
///     parallel   Kp + Ki/s + Kd s
///     standard   Kc (1 + 1/(Ti s) + TD s)                                    [Huba2022 (18)]
///     series     Kc (1 + 1/(Ti s)) (1 + TD s)                                [Huba2022 (51), left]
///
/// unit      any consistent set; Ti = inf means no integral action in all three
#pragma once

#include <optional>

namespace portrait {

struct ParallelForm {
  double Kp, Ki, Kd;
};
struct StandardForm {
  double Kc, Ti, TD;
};
struct SeriesForm {
  double Kc, Ti, TD;
};

ParallelForm parallel(const StandardForm& form);

/// REQUIRES: Kp != 0.
StandardForm standard(const ParallelForm& form);

/// Always possible.                                                           [Huba2022 (52)]
StandardForm standard(const SeriesForm& form);

/// Exists when Ti >= 4 TD, that is when both zeros are real; of the two solutions the one with the longer
/// integral time.                                                             [Huba2022 (53), upper signs]
std::optional<SeriesForm> series(const StandardForm& form);

}  // namespace portrait
