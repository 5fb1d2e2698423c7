/// From a normalised loop back to the units of the plant.
///
///     t = time t'      setpoint and output step 1:  y = y', u = u'/gain      disturbance step 1:  y = gain y', u = u'
#pragma once

#include "engine/measures/catalogue.h"

namespace portrait {

struct Units {
  double time = 1;  ///< what 1 is in time: the dead time, where there is one
  double gain = 1;  ///< the output that one unit of input builds up in one unit of time; its sign is the plant's
};

/// A normalised measure times this is that of the loop in its own units, for steps of size one there.
double scale(Measure measure, const Units& units);

}  // namespace portrait
