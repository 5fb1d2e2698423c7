/// One closed loop: a plant with dead time, a controller, its filter and its prefilter, all normalised.
///
///     w --> F(s) --r--> (+) --e--> C(s) Q(s) --u--> (+) --> P(s) --> y
///                     - ^                       d ^                 |
///                       +-------------------------------------------+
///
///     P   plant            dipdt e^{-s}/s^2,  ipdt e^{-s}/s,  fotd e^{-s}/(tau_1 s + 1)       [Huba2022 (7)]
///                          jotd e^{-s}/(tau_j s + 1)^j                                        [Huba2021 (1)]
///     C   controller       kappa (1 + 1/(tau_i s) + tau_d s),  delta = kappa tau_d            [Huba2022 (18)]
///                          or, given by gains, K_-1/s + K_0 + K_1 s + ... + K_m s^m, n >= m   [HO-PID (1)]
///     Q   filter           1/(tau_f s + 1)^n                                                  [Huba2022 (39)]
///     F   prefilter        full, pi or none, see `Prefilter`                        [Huba2022 (16), (24), (44)]
///
/// n >= 1: the whole controller acts on r - y through Q. n = 0: there is no filter and the ideal derivative
/// acts on the measured output alone, u = kappa (r - y) + (kappa/tau_i) int(r - y) - delta y', so that u has
/// no impulses.
///
/// unit      time in dead times, plant gain 1: everything in engine/ is normalised, real_plant.h leads out and in
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace portrait {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

enum class Plant { dipdt, ipdt, fotd, jotd };

enum class Prefilter {
  full,  ///< (1 + b s + c s^2)/(1 + tau_i s + tau_i tau_d s^2);  tau_i = inf: (1 + b s)/(1 + tau_d s)
  pi,    ///< (1 + b tau_i s)/(1 + tau_i s);  tau_i = inf: 1
  none,  ///< 1
};

inline constexpr std::array<std::string_view, 4> kPlantNames = {"dipdt", "ipdt", "fotd", "jotd"};
inline constexpr std::array<std::string_view, 3> kPrefilterNames = {"full", "pi", "none"};

constexpr std::string_view to_string(Plant plant) { return kPlantNames[static_cast<std::size_t>(plant)]; }
constexpr std::string_view to_string(Prefilter prefilter) {
  return kPrefilterNames[static_cast<std::size_t>(prefilter)];
}
std::optional<Plant> plant_named(std::string_view name);
std::optional<Prefilter> prefilter_named(std::string_view name);

/// Pure integrators of the plant: a constant input makes y grow without bound when there is one.
constexpr int integrators(Plant plant) { return plant == Plant::dipdt ? 2 : plant == Plant::ipdt ? 1 : 0; }

/// The prefilter that cancels the controller's zeros: `pi` with the derivative of the output, else `full`.
constexpr Prefilter usual_prefilter(int n) { return n == 0 ? Prefilter::pi : Prefilter::full; }

inline constexpr int kMaxFilterOrder = 16;
inline constexpr int kMaxPlantOrder = 8;  ///< j of jotd
inline constexpr int kMaxGainOrder = 6;   ///< m of K_m

/// What all settings of a grid have in common.
struct LoopFamily {
  Plant plant = Plant::dipdt;
  int n = 0;  ///< filter order, 0 .. kMaxFilterOrder
  Prefilter prefilter = Prefilter::pi;
  int j = 0;   ///< order of jotd, 1 .. kMaxPlantOrder; 0 for the other plants
  int m = -1;  ///< of a controller given by its gains K_-1 .. K_m, 0 .. kMaxGainOrder; -1: kappa, tau_i, delta
};

constexpr bool has_gains(const LoopFamily& family) { return family.m >= 0; }

/// The families of the papers' tables proper, whose loops have a form of their own in most rooms; the others are written
/// out as general loops there.
constexpr bool is_basic(const LoopFamily& family) { return family.plant != Plant::jotd && !has_gains(family); }

/// One point of a grid: the numbers of one closed loop. tau_1 belongs to fotd, tau_j to jotd, tau_f to n >= 1; either
/// kappa, tau_i, delta or gains.
struct Setting {
  double kappa = 0;
  double tau_i = kInf;
  double delta = 0;
  double tau_1 = 0;
  double tau_f = 0;
  double b = 0;
  double c = 0;
  double tau_j = 0;
  std::array<double, kMaxGainOrder + 2> gains{};  ///< K_-1, K_0, ..., those above m 0; all 0 beside kappa
};

constexpr double tau_d(const Setting& setting) { return setting.delta / setting.kappa; }
constexpr bool has_integral_action(const Setting& setting) { return setting.tau_i < kInf || setting.gains[0] > 0; }

struct Loop {
  LoopFamily family;
  Setting setting;
};

/// K_-1, K_0, ... K_m of any of them: a PID controller's are kappa/tau_i, kappa, delta.
std::array<double, kMaxGainOrder + 2> gains_of(const Loop& loop);

/// Time constants of the plant's lags that are not integrators: how many, and how long each.
struct PlantLags {
  int count = 0;
  double time = 0;
};
constexpr PlantLags plant_lags(const Loop& loop) {
  if (loop.family.plant == Plant::fotd) return {1, loop.setting.tau_1};
  if (loop.family.plant == Plant::jotd) return {loop.family.j, loop.setting.tau_j};
  return {};
}

/// Why no loop of this family can be simulated, whatever its numbers: orders out of range, gains without a filter.
std::optional<std::string> why_invalid(const LoopFamily& family);

/// Why this loop cannot be simulated ("tau_f must be above 0 (it is 0)"), or nothing when it can.
/// Every border (grid file, command line) asks before any work; the engine then only checks.
std::optional<std::string> why_invalid(const Loop& loop);

}  // namespace portrait
