/// The responses of a general loop without dead time.
///
/// Closed, the loop is x' = A x + E v, and one matrix exponential takes it over a panel exactly: x at the panel's nodes
/// is a constant map of x at its start. A panel on which a signal's last coefficients have not died out is halved; after
/// one on which they have died out early the next is twice as long.
/// accuracy  that of the exponential, 1e-13 of the largest state: tests/engine/reference/general_loop_test.cpp
/// cost      a few exponentials of a small matrix for every length of panel, one product a panel
#pragma once

#include <span>

#include "engine/reference/response.h"

namespace portrait::reference {

/// An automatic horizon ends when the slowest root has let the response die out; see `simulate`.
/// REQUIRES: the loop is valid and its dead time 0; for an automatic horizon also stable.
Response simulate_without_dead_time(const GeneralLoop& loop, Horizon horizon, const Accuracy& accuracy,
                                    std::span<const Step> steps);

}  // namespace portrait::reference
