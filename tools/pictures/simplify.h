/// A curve with fewer points that looks the same: smooth stretches need few, corners all of theirs.
///
/// method    Douglas and Peucker: of each stretch the point farthest from its chord is kept while it is farther than allowed
/// accuracy  no point of the given curve is farther than `within` from the new one, x and y each measured in shares of their
///           span over the curve: tests/tools/pictures/simplify_test.cpp
#pragma once

#include "tools/pictures/contours.h"

namespace portrait::pictures {

/// Keeps the first and the last point. Points that are not finite are kept, and with them the gaps that they make.
Outline simplified(const Outline& curve, double within);

}  // namespace portrait::pictures
