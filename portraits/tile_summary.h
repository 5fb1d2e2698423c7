/// What a portrait keeps of a tile beside its values, so that a query can tell whether the values can matter without
/// reading them: of a measure its range, of the status how often each outcome occurs.
///
/// shape     a row of numbers, float64 whatever the precision of the values, so that a bound is never rounded
/// accuracy  exact: the least and greatest of the values as stored. tests/portraits/tile_summary_test.cpp
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/status.h"

namespace portrait {

/// Of one measure in one tile.
struct TileRange {
  double least;           ///< of the values that are no NaN; inf when there are none
  double greatest;        ///< -inf when there are none
  std::uint64_t missing;  ///< how many are NaN
};

/// How many settings of one tile have each status.
using StatusCounts = std::array<std::uint64_t, kStatusNames.size()>;

inline constexpr std::size_t kRangeNumbers = 3;

/// `values` are doubles or floats, as they are stored.
TileRange range_of(std::span<const std::byte> values, std::size_t element);
/// Codes beyond the known ones are not counted.
StatusCounts status_counts_of(std::span<const std::byte> codes);

/// As the file keeps them: least, greatest, missing; or the counts.
std::vector<double> range_summary(std::span<const std::byte> values, std::size_t element);
std::vector<double> status_summary(std::span<const std::byte> codes);

}  // namespace portrait
