/// Pictures of single loops side by side: their responses, Nyquist curves and measures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/loop/horizon.h"
#include "engine/loop/loop.h"
#include "engine/loop/real_plant.h"
#include "engine/measures/catalogue.h"
#include "tools/pictures/gnuplot.h"

namespace portrait::pictures {

struct NamedLoop {
  std::string label;
  Loop loop;
};

/// y and u after a unit step of the setpoint (left) and of the input disturbance (right).     [Huba2022 Figures 1-3, 11]
/// Normalised, or in the units of `plant`. REQUIRES: the loops are valid; for an automatic horizon stable.
Script responses(const std::string& title, const std::vector<NamedLoop>& loops, Horizon horizon,
                 const std::optional<RealPlant>& plant);

/// L(j omega) with the unit circle and each loop's circle of radius 1/Ms about -1, which it touches; with `Ms` above 1
/// the circle of that bound instead.                                                          [Huba2022 Figure 4]
Script nyquist(const std::string& title, const std::vector<NamedLoop>& loops, double Ms);

/// A panel a measure, a bar a loop.                                                   [Huba2022 Figures 5-9, 14]
struct Bars {
  std::string label;
  std::vector<double> values;  ///< one for each loop; NaN leaves a gap
};
Script bars(const std::string& title, const std::vector<std::string>& loops, const std::vector<Bars>& measures);

/// Points of a response, a jump as two of them with one t.
struct Sampled {
  std::vector<double> t, y, u;
};
/// Both steps by `Step`; at most `most` points each, panels and their edges kept.
std::vector<Sampled> sampled_responses(const Loop& loop, Horizon horizon, std::size_t most);

/// L(j omega) from where |L| is `largest` to where it is `smallest`, at equal steps of log omega.
std::vector<Point> nyquist_curve(const Loop& loop, double largest, double smallest, std::size_t points);

}  // namespace portrait::pictures
