#include "engine/loop/units.h"

#include <cmath>
#include <limits>

namespace portrait {

double scale(Measure measure, const Units& units) {
  const MeasureInfo& m = info(measure);
  const double gain = std::abs(units.gain), time = units.time;
  const double y = m.step == 'd' ? gain : 1;
  const double u = m.step == 'd' ? 1 : 1 / gain;
  switch (m.unit) {
    case Unit::one:
    case Unit::degree:
      return 1;
    case Unit::time:
      return time;
    case Unit::output:
      return y;
    case Unit::output_time:
      return y * time;
    case Unit::output_time2:
      return y * time * time;
    case Unit::output2_time:
      return y * y * time;
    case Unit::output2_time2:
      return y * y * time * time;
    case Unit::input:
      return u;
    case Unit::input_per_output:
      return 1 / gain;
    case Unit::per_time:
      return 1 / time;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace portrait
