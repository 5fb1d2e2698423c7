/// Where short texts stand beside their points, so that they hide neither each other nor what is drawn.
///
/// unit      characters of the picture's font: widths to the right, heights upwards, from the panel's lower left corner
/// method    in their order each text takes the first of some places around its point, near ones first, that lies within the
///           panel on nothing; where none is free, the one on which it hides least
/// accuracy  tests/tools/pictures/labels_test.cpp
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/pictures/contours.h"

namespace portrait::pictures {

struct LabelPlace {
  double dx, dy;  ///< from the point to the middle of the text
};

/// `at` are the points and `widths` the texts' lengths; `drawn` is what should stay visible beside the points themselves.
/// REQUIRES: as many points as widths.
std::vector<LabelPlace> label_places(const std::vector<Point>& at, const std::vector<std::size_t>& widths,
                                     const std::vector<Point>& drawn, Point panel);

}  // namespace portrait::pictures
