/// The plain way to simulate a grid: the loop's differential equations by the classical Runge-Kutta method of order
/// four, a fixed number of steps a dead time, the delayed output from a ring buffer. What the engine is measured
/// against.
///
/// Both step responses; a filter of first order; the prefilter `full` with b = c = 0. IAE and TV only.
/// unit      normalised: time in dead times, plant gain 1
/// accuracy  bench/proof.h holds it to the reference before anything is timed
///
/// Includes nothing: the border between code compiled once per instruction set and the rest.
#pragma once

namespace portrait::bench {

enum class StepPlant { dipdt, ipdt, fotd };

/// What all settings of a run have in common.
struct StepTask {
  StepPlant plant;
  bool derivative;  ///< false: delta is 0 in every setting
  int steps;        ///< per dead time, 4 .. kMaxSteps
  int dead_times;
};

inline constexpr int kMaxSteps = 1000;

struct StepSetting {
  double kappa, tau_i, delta, tau_1, tau_f;
};

struct StepMeasures {
  double iae, tv_y, tv_u;
};

struct BothSteps {
  StepMeasures w, d;
};

/// The loops of one instruction set.
struct Baseline {
  const char* name;
  int lanes;  ///< settings that `batched` takes side by side
  /// One setting after the other, in scalar code.
  void (*scalar)(const StepTask&, const StepSetting*, int count, BothSteps*);
  /// The same loop on `lanes` settings at a time.
  void (*batched)(const StepTask&, const StepSetting*, int count, BothSteps*);
  /// Multiplies and adds in registers as fast as this set can. Gives the number of floating-point operations.
  double (*multiply_and_add)(long rounds);
};

}  // namespace portrait::bench
