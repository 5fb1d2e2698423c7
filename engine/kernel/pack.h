/// What goes into a run of the kernel and what comes out: plain arrays, the border between vector code and the rest.
///
/// A pack is `lanes` settings side by side. Entries beyond the settings at hand repeat the last one. Includes nothing, so
/// that the files compiled per instruction set stay free of library code.
#pragma once

namespace portrait::kernel {

inline constexpr int kMaxLanes = 16;
inline constexpr int kMaxPanels = 24;

enum class PlantKind { dipdt, ipdt, fotd };

/// How y_w is found.
enum class SetpointRun {
  from_disturbance,  ///< from the disturbance run, by g0, g1, g2
  lag,               ///< a run of its own behind the prefilter (1 + b_r s)/(1 + a1 s)
};

using PackColumn = double[kMaxLanes];

struct Pack {
  PlantKind plant;
  int n;  ///< filter order
  SetpointRun setpoint_run;
  double horizon;  ///< dead times
  int panels;      ///< a dead time is cut into so many, each lane at its own places

  PackColumn kappa, integral_gain, delta, tau_1, tau_f;  ///< integral_gain = kappa/tau_i, 0 without integral action
  PackColumn g0, g1, g2;                                 ///< y_w = -(g0 int v + g1 v + g2 v')
  PackColumn a1, b_r;
  PackColumn y_rest_w, u_rest_w, y_rest_d, u_rest_d;
  double panel_length[kMaxPanels][kMaxLanes];  ///< from left to right, sum 1
};

/// One step's measures.
struct StepColumns {
  PackColumn iae, ise, itae, itse;
  PackColumn tv_y, tv0_y, tv1_y, tv2_y, y_max;
  PackColumn tv_u, tv0_u, tv1_u, tv2_u, u_max;
};

struct PackResult {
  StepColumns w, d;
  /// Largest deviation from rest over the last dead time, as a part of the largest of all: of y and u, both steps.
  PackColumn late;
  PackColumn tail;        ///< largest last coefficients as a part of the signal: how far from resolved
  PackColumn dead_times;  ///< simulated
};

/// Number of settings a pack holds, and the run itself, of one instruction set.
struct Implementation {
  const char* name;
  int lanes;
  void (*run)(const Pack&, PackResult&);
};

}  // namespace portrait::kernel
