/// Points with a number beside each; what the numbers mean stands in the key.
#pragma once

#include <string>
#include <vector>

#include "tools/pictures/map.h"

namespace portrait::pictures {

/// Where an axis of the panel begins and ends.
struct Span {
  double low, high;
  bool log = false;
  double share(double value) const;  ///< 0 at low, 1 at high
};

/// "set label ..." lines go into the script; gives ", $d3 using 1:2 with points .. title '1  simc-pi'" for each mark.
/// `panel`: its width and height in characters.
std::string numbered(Script& script, const std::vector<Mark>& marks, Span x, Span y, Point panel,
                     const std::vector<Point>& drawn);

}  // namespace portrait::pictures
