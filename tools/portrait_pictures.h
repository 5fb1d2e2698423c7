/// Pictures of a whole portrait as `portrait plot` and `portrait report` draw them.
#pragma once

#include <string>

#include "tools/plot_arguments.h"

namespace portrait::tools {

struct MapArguments : PlotArguments {
  std::string x, y, colour, uncertain;
  int levels = 12;
  bool stability = false, rules = false;
};

struct FrontArguments : PlotArguments {
  std::string x, y;
  bool rules = false;
};

struct PortraitPicture {
  std::string title;
  pictures::Script script;
  bool complete;  ///< false: nothing is admissible, so that optimum or front is missing
};

/// Throws InputError when the arguments do not fit the portrait.
PortraitPicture map_picture(const MapArguments& a);
PortraitPicture front_picture(const FrontArguments& a);

}  // namespace portrait::tools
