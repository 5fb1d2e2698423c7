/// What a block of settings came to: a column per kept measure and one of statuses.
///
/// shape     every column has one entry per setting, settings in the order of the block
/// unit      normalised; NaN where a measure does not exist
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
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

  /// A run of outcomes, each with `status` and `measures`. Column by column, a few settings at a time: what lies between
  /// two settings is long, and what lies between two columns longer.
  /// REQUIRES: first + outcomes.size() <= settings().
  template <typename Outcome>
  void set_all(std::size_t first, std::span<const Outcome> outcomes) {
    constexpr std::size_t kAtOnce = 16;
    for (; !outcomes.empty(); first += kAtOnce, outcomes = outcomes.subspan(std::min(kAtOnce, outcomes.size()))) {
      const std::size_t count = std::min(kAtOnce, outcomes.size());
      for (std::size_t i = 0; i < count; ++i) status[first + i] = outcomes[i].status;
      for (std::size_t k = 0; k < kept.size(); ++k)
        for (std::size_t i = 0; i < count; ++i) values[k][first + i] = outcomes[i].measures[kept[k]];
    }
  }

  std::vector<Measure> kept;                ///< in catalogue order
  std::vector<std::vector<double>> values;  ///< values[k][setting] of kept[k]
  std::vector<Status> status;               ///< status[setting]
};

}  // namespace portrait
