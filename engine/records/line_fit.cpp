#include "engine/records/line_fit.h"

namespace portrait::records {

LineFit line_fit(const Record& r, std::size_t from, std::size_t to) {
  LineFit line;
  const double n = static_cast<double>(to - from);
  for (std::size_t i = from; i < to; ++i) line.middle += r.t[i] / n, line.level += r.y[i] / n;
  double tt = 0, ty = 0;
  for (std::size_t i = from; i < to; ++i) {
    const double t = r.t[i] - line.middle;
    tt += t * t, ty += t * (r.y[i] - line.level);
  }
  line.slope = tt > 0 ? ty / tt : 0;
  return line;
}

}  // namespace portrait::records
