/// A straight line through a stretch of a record's output, by least squares.
#pragma once

#include "engine/records/record.h"

namespace portrait::records {

struct LineFit {
  double middle = 0, level = 0, slope = 0;  ///< y = level + slope (t - middle)

  double level_at(double t) const { return level + slope * (t - middle); }
};

/// Of samples from .. to - 1. REQUIRES: from < to.
LineFit line_fit(const Record& record, std::size_t from, std::size_t to);

}  // namespace portrait::records
