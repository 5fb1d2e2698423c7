/// A portrait as it is drawn: in real units when a plant was given.
#pragma once

#include <string>

#include "portraits/query/query_units.h"
#include "portraits/reader.h"
#include "tools/plot_arguments.h"

namespace portrait::tools {

struct ShownPortrait {
  /// `plant_text` as typed for --plant; empty for none. Throws InputError when the plant does not fit.
  ShownPortrait(const std::string& file, const std::string& plant_text)
      : portrait(file), units{plant_argument(plant_text, portrait.grid().family.plant).real, {}} {
    require_fits(units, portrait.grid());
  }

  const Grid& grid() const { return portrait.grid(); }
  bool has_plant() const { return units.plant.has_value(); }

  PortraitReader portrait;
  QueryUnits units;
};

}  // namespace portrait::tools
