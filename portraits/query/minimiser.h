/// The least value of a function under constraints, from a point that meets them: sequential quadratic programming inside a
/// trust region, every accepted point admissible, and a poll around the end.
///
/// Gradients are central differences; the quadratic model's matrix follows by damped BFGS. The quadratic programme is
/// solved by trying all sets of constraints that may be active, which for a handful of variables is the surest way. A step
/// that leaves the admissible region is corrected with the constraints' values where it led; one that does not come back or
/// is no better halves the region. Where the function has kinks the model may be caught, hence the poll: points all around,
/// near and far, of which a better one starts everything anew.
///
/// accuracy  1e-6 of the distance a variable can move, functions smooth: tests/portraits/query/minimiser_test.cpp
/// result    the same for the same function: the poll's directions are fixed
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace portrait {

/// A function at a point; inf where it does not exist.
struct Probe {
  double objective;
  std::vector<double> constraints;  ///< at most 0 where they are met
};

struct MinimiserProblem {
  /// Many points at once; each a value per variable. The variables are scaled so that 1 is a step worth trying.
  std::function<std::vector<Probe>(const std::vector<std::vector<double>>& points)> probe;
  std::vector<double> low, high;  ///< bounds of the variables
  std::vector<double> start;      ///< within them, and admissible
};

struct Minimum {
  std::vector<double> point;
  Probe probe;
  std::vector<double>
      prices;  ///< by constraint: how fast the objective falls as it is loosened; 0 where it is not active
  std::size_t probes = 0;
  bool converged = false;  ///< no step larger than kLeastStep helps
};

inline constexpr double kLeastStep = 1e-7;

/// REQUIRES: one to kMostVariables variables; the start is admissible.
Minimum minimise(const MinimiserProblem& problem);
inline constexpr std::size_t kMostVariables = 8;

}  // namespace portrait
