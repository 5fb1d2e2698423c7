/// Some settings of a portrait, chosen at random, simulated once more by the reference and compared with what is stored:
/// whether the numbers are right, where digests only tell that they are those that were written.
///
/// error     integrals and properties of the loop: of the value, or of 1e-3 where it is smaller. Variations and peaks of a
///           signal: of the signal's total variation. The place of a peak: also right where the curve is as high. With
///           tau_f below 1e-3 an error counts as tau_f/1e-3 of itself, since rounding grows as 1/tau_f in either method
/// allowed   1e-8 for the first, 1e-7 for the second (what engine/kernel promises), and 1.2e-7 more in single precision;
///           NaN, inf and the status must be the same
/// cost      memory: 8 bytes for each setting of the sample, and kBlock settings. Time: milliseconds a setting and thread
/// tests     tests/portraits/sample_check_test.cpp
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "portraits/column_source.h"

namespace portrait {

struct SampleRequest {
  std::uint64_t settings = 0;  ///< all of the portrait when it has fewer
  std::uint64_t seed = 0;
  int threads = 0;                                         ///< 0: as many as the machine has
  std::function<void(std::uint64_t settings)> progress{};  ///< may be empty
};

/// How one measure fared.
struct MeasureCheck {
  Measure measure;
  double allowed = 0;
  double worst = 0;         ///< error; inf when one of the two values is no number
  std::uint64_t where = 0;  ///< setting of the worst
  double stored = 0, truth = 0;
  std::uint64_t failed = 0;  ///< settings in which the error is above what is allowed
};

struct StatusMismatch {
  std::uint64_t where;
  Status stored, truth;
};

struct SampleReport {
  std::uint64_t settings = 0;
  std::uint64_t failed = 0;  ///< settings with any difference
  std::vector<MeasureCheck> measures;
  std::vector<StatusMismatch> statuses;  ///< the first kMostMismatches of those that differ
};

inline constexpr std::size_t kMostMismatches = 10;

/// Setting numbers below `total`, each once, in order; the same for the same seed everywhere.
std::vector<std::uint64_t> random_settings(std::uint64_t total, std::uint64_t count, std::uint64_t seed);

/// Throws what reading throws, and IntegrityError for a setting that no sweep takes.
SampleReport check_sample(const ColumnSource& source, const SampleRequest& request);

}  // namespace portrait
