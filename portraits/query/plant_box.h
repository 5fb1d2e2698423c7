/// A plant that is known only within bounds: every K, Td (and T1, of jotd Tj) of a box, seen by one real controller.
///
/// The controller stays as it is in real units while the plant moves, so its normalised setting moves along a curved patch
/// of the portrait: kappa = Kc K Td^2 (dipdt), tau_i = Ti/Td, tau_f = Tf/Td, tau_1 = T1/Td, ... Each of them rises or falls
/// with each of K, Td, T1 throughout, so the patch's extent lies at the corners of the box; measures need not.
/// unit      real, those of the plant
/// accuracy  tests/portraits/query/plant_box_test.cpp
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/loop/real_plant.h"
#include "grids/grid.h"

namespace portrait {

struct Range {
  double low, high;
  bool is_wide() const { return low < high; }
  bool contains(double value) const { return low <= value && value <= high; }
};

/// A place in a box: from 0 at the low end to 1 at the high end of K, Td and T1, in this order.
using BoxPoint = std::array<double, 3>;

struct PlantBox {
  RealPlant nominal;  ///< in the box; the grid's settings are controllers for it
  Range K, Td, T1;

  /// Which of K, Td, T1 vary: 0, 1, 2.
  std::vector<std::size_t> uncertain() const;
  RealPlant at(const BoxPoint& point) const;
  /// All corners; the plant itself when nothing varies.
  std::vector<BoxPoint> corners() const;
  /// Cells of equal size, about `count` in all: their middles.
  std::vector<BoxPoint> middles(std::size_t count) const;
};

/// "K", "Td", and the time constant of the family's lags: "T1", "Tj".
std::string_view name_of_uncertain(Plant family, std::size_t which);

/// Why such a box cannot be, or nothing: an end out of order, a plant that cannot be, a gain of either sign, a nominal
/// plant outside.
std::optional<std::string> why_invalid(const PlantBox& box);

/// The setting that the controller of `loop` on the nominal plant is on another one.
Setting seen_by(const RealPlant& plant, const Loop& loop, const RealPlant& nominal);

/// How far a parameter of the setting moves over the box, and whether that leads beyond the grid.
struct Extent {
  Parameter parameter;
  double low, high;
  bool leaves_grid;  ///< below its least or above its greatest value
};
/// Those parameters that move, in printing order.
std::vector<Extent> patch_of(const Grid& grid, const PlantBox& box, const Setting& setting);

}  // namespace portrait
