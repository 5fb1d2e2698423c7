/// What a block of settings came to: a column per kept measure and one of statuses.
///
/// shape     every column has one entry per setting, settings in the order of the block
/// unit      normalised; NaN where a measure does not exist
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/status.h"
#include "engine/measures/catalogue.h"

namespace portrait {

struct MeasureColumns {
  /// All NaN and not computed.
  MeasureColumns(std::vector<Measure> measures, std::size_t settings)
      : kept(std::move(measures)),
        values(kept.size(), std::vector<double>(settings, std::numeric_limits<double>::quiet_NaN())),
        status(settings, Status::not_computed) {}

  std::size_t settings() const { return status.size(); }

  /// REQUIRES: setting < settings().
  void set(std::size_t setting, Status outcome, const MeasureRow& row) {
    status[setting] = outcome;
    for (std::size_t k = 0; k < kept.size(); ++k) values[k][setting] = row[kept[k]];
  }

  std::vector<Measure> kept;                ///< in catalogue order
  std::vector<std::vector<double>> values;  ///< values[k][setting] of kept[k]
  std::vector<Status> status;               ///< status[setting]
};

}  // namespace portrait
