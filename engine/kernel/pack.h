/// What goes into a run of the kernel and what comes out: plain arrays, the border between vector code and the rest.
///
/// A pack is `lanes` settings side by side. Entries beyond the settings at hand repeat the last one. Includes nothing, so
/// that the files compiled per instruction set stay free of library code.
#pragma once

namespace portrait::kernel {

inline constexpr int kMaxLanes = 8;
inline constexpr int kMaxPanels = 64;
inline constexpr int kMaxFilters = 16;

inline constexpr int kMaxGains = 8;
inline constexpr int kMaxPlantOrder = 8;

enum class PlantKind {
  dipdt,
  ipdt,
  fotd,
  cascade,  ///< integrators and equal lags, any number; the controller given by its gains
};
constexpr int integrators(PlantKind plant) {
  return plant == PlantKind::dipdt ? 2 : plant == PlantKind::ipdt ? 1 : 0;
}

/// How y_w is found.
enum class SetpointRun {
  from_disturbance,  ///< from the disturbance run, by g0, g1, g2
  lag,               ///< a run of its own behind the prefilter (1 + b_r s)/(1 + a1 s)
  second_order,      ///< a run of its own behind (1 + b_r s + c_r s^2)/(1 + a1 s + a2 s^2)
};

/// How a dead time is cut into panels, for all lanes alike: the first panel 2^-graded of it, each further one as long as all
/// before it together; then every panel in halves, `halved` times.
///
///     graded = 0: |----------------|      graded = 2: |---|---|-------|
struct Mesh {
  int graded;
  int halved;
};
constexpr int panels_of(const Mesh& mesh) { return (mesh.graded + 1) << mesh.halved; }

using PackColumn = double[kMaxLanes];

/// Where a pack's signals go at the instants k Ts, k = 0 .. count - 1: a row of kMaxLanes an instant.
struct PackSamples {
  double sampling;  ///< dead times
  int count;
  double *y_w, *u_w, *y_d, *u_d;
};

struct Pack {
  PlantKind plant;
  int n;  ///< filter order
  SetpointRun setpoint_run;
  bool slow_filter;       ///< tau_f is no small number: engine/kernel/filter.inl
  double horizon;         ///< dead times
  Mesh mesh;              ///< while layers of the fast time constants matter, after every dead time anew
  int layered_intervals;  ///< so many dead times; from then on `graded` is 0
  int smooth_from;        ///< from this dead time on series end at a lower degree; not before `graded` is 0

  PackColumn kappa, integral_gain, delta, tau_1, tau_f;  ///< integral_gain = kappa/tau_i, 0 without integral action
  PackColumn g0, g1, g2;                                 ///< y_w = -(g0 int v + g1 v + g2 v')
  PackColumn a1, a2, b_r, c_r;
  PackColumn y_rest_w, u_rest_w, y_rest_d, u_rest_d;

  // Of a cascade, whose lags have the time constant tau_1.
  int m;                        ///< derivatives in the controller; n = 0: one, of the output
  int lags, integrators;        ///< of the plant
  PackColumn gains[kMaxGains];  ///< K_-1, K_0, ...

  const PackSamples* samples;  ///< null: none are taken
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
  PackColumn tail;         ///< largest last coefficients as a part of the signal: how far from resolved
  PackColumn smooth_tail;  ///< the same from `smooth_from` on
  PackColumn dead_times;   ///< simulated
};

/// Sampled responses of a pack, and noise for it: engine/kernel/noise.inl.
struct NoisePack {
  int samples, size;  ///< of the transform, a power of 2 not below 2 samples - 1
  int seeds;
  const double *loop_y, *loop_u;        ///< after a setpoint step without prefilter, a row an instant
  const double *y_w, *u_w, *y_d, *u_d;  ///< of the loop itself
  PackColumn y_rest_w, u_rest_w, y_rest_d, u_rest_d;
  const double* turns;    ///< cos and -sin of 2 pi i/size, i = 0 .. size/2 - 1
  const double* spectra;  ///< of each seed's noise, over size, as NoiseSeries::transform leaves them
  double* work;           ///< two series: 4 size kMaxLanes numbers
};

/// Of one seed: TV, TV0, TV1, TV2 of y and u after w, of y and u after d; and the sum of squares of the noise's part of u over
/// the second half of the instants.
struct NoiseTrial {
  PackColumn shapes[16];
  PackColumn u_squares;
};

struct NoiseResult {
  PackColumn expected;  ///< sqrt(sum g_j^2) of u
  NoiseTrial* trials;   ///< one for each seed
};

/// Open loops, all with integral action or all without.
struct MarginPack {
  PlantKind plant;
  bool integral;
  int n;

  PackColumn kappa, tau_i, delta, tau_1, tau_f;
};

/// Open loops of one family of many lags or of gains, stable ones, each with one gain crossover or none, and what is known of
/// |L| over x = omega^2.
struct CascadeMarginPack {
  int degree;                       ///< of N = c_0 + c_1 s + ..., c_0 above 0
  int integrators, lags, filters;   ///< of the open loop, the controller's integrator included
  PackColumn numerator[kMaxGains];  ///< c_0, c_1, ...
  PackColumn lag, tau_f;
  PackColumn rest;                  ///< omega below which L is what it is at rest
  PackColumn leads;                 ///< x up to which arg L stays above -pi
  PackColumn crossover;             ///< omega; 0: |L| stays below 1
  PackColumn rises_from, rises_to;  ///< |L| falls up to the one and from the other on; inf: all the way; never
  PackColumn top;                   ///< at least |L|^2 between the two
  PackColumn end;                   ///< |L| at infinity
};

/// Of an unstable loop everything but the first two is undefined; inf and 0 as in engine/measures/catalogue.h.
struct MarginResult {
  PackColumn known;  ///< 0 where the loop may cross |L| = 1 more than once, or the search was given up; else 1
  PackColumn stable;
  PackColumn Ms, Ms_omega, Mt, Mt_omega, GM, GM_low, PM, DM;
};

/// What one instruction set offers.
struct Implementation {
  const char* name;
  int lanes;  ///< settings a pack holds
  void (*run)(const Pack&, PackResult&);
  void (*find_margins)(const MarginPack&, MarginResult&);
  void (*find_cascade_margins)(const CascadeMarginPack&, MarginResult&);  ///< all but PM, DM and `stable`
  void (*run_noise)(const NoisePack&, NoiseResult&);
};

}  // namespace portrait::kernel
