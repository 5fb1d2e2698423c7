/// Speed against effort and wobbling: how far the input and the output deviate from their ideal shapes to the right, the
/// integral of the error upwards, a curve a family of loops.                           [Huba2021 Figures 9-12, 15, 18, 20, 22]
#pragma once

#include <string>
#include <vector>

#include "tools/pictures/gnuplot.h"

namespace portrait::pictures {

/// One loop of a family: `value` is what was varied.
struct CharacteristicAt {
  double speed, effort, wobbling;  ///< NaN: the curve has a gap there
  std::string value;
};

struct CharacteristicCurve {
  std::string label;
  std::vector<CharacteristicAt> points;
};

struct Characteristics {
  std::string title, speed_label, effort_label, wobbling_label;
  std::vector<CharacteristicCurve> curves;
};

/// Two panels, effort at the left and wobbling at the right; the first and the last value of each curve stand beside it.
Script script(const Characteristics& picture);

}  // namespace portrait::pictures
