/// The line of `portrait simulate` as typed; empty means not given.
#pragma once

#include <cstdint>
#include <string>

namespace portrait::tools {

struct SimulateArguments {
  std::string plant, kappa, tau_i, delta, tau_d, tau_1, tau_f, b = "0", c = "0", prefilter, horizon = "auto",
                                                               sampling, method, trace;
  /// Beyond the normalised families.
  std::string K, Td, tau_j, pid, gains, controller, weights, step, time_unit;
  /// Measurement noise, held over `sampling`.
  std::string noise, noise_kind = "uniform";
  std::uint64_t seed = 1;
  int seeds = 1;
  bool sampled = false;
  int n = -1, j = 0;
  bool json = false;
};

/// Without --n a filter constant asks for a first-order filter.
inline int filter_order(const SimulateArguments& a) { return a.n >= 0 ? a.n : a.tau_f.empty() ? 0 : 1; }

/// Whether anything on the line lies beyond the normalised families.
bool is_general(const SimulateArguments& a);

/// Simulates a general loop in its own units and prints what came out; gives the exit code. Throws InputError.
int simulate_general(const SimulateArguments& a);

}  // namespace portrait::tools
