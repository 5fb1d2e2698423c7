/// Integrals of the error e = target - y over a response:
///
///     IAE  int |e| dt      ISE  int e^2 dt      ITAE  int t |e| dt      ITSE  int t e^2 dt
///
/// Those of |e| are split at the sign changes of e, and all are taken from antiderivatives of series: nothing is
/// sampled.
/// unit      time in dead times, from 0 to the end of the pieces
#pragma once

#include <vector>

#include "engine/reference/response.h"

namespace portrait::reference {

struct ErrorIntegrals {
  double IAE = 0, ISE = 0, ITAE = 0, ITSE = 0;
};

/// `noise`: how far rounding alone may have moved y.
ErrorIntegrals error_integrals(const std::vector<Piece>& pieces, double target, double noise);

}  // namespace portrait::reference
