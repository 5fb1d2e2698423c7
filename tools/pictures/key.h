/// A key in a strip of its own below the panels, in as many columns as its titles leave room for.
#pragma once

#include <string>
#include <vector>

namespace portrait::pictures {

struct Key {
  std::string lines;  ///< "set key .." and "set bmargin .."
  double height_cm;   ///< of the strip, to be added to that of the picture
};

/// `titles` in the order in which they are plotted; the picture is `width_cm` wide.
Key key_below(const std::vector<std::string>& titles, double width_cm);

}  // namespace portrait::pictures
