#include "portraits/tile_summary.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/base/check.h"

namespace portrait {
namespace {

constexpr std::size_t kLanes = 8;  ///< chains of comparisons side by side

/// NaN is in no comparison, so it changes neither bound.
template <typename Real>
class Lanes {
 public:
  Lanes() {
    least_.fill(std::numeric_limits<double>::infinity());
    greatest_.fill(-std::numeric_limits<double>::infinity());
  }

  void add(std::size_t lane, const std::byte* from) {
    Real stored;
    std::memcpy(&stored, from, sizeof stored);
    const auto value = static_cast<double>(stored);
    least_[lane] = value < least_[lane] ? value : least_[lane];
    greatest_[lane] = value > greatest_[lane] ? value : greatest_[lane];
    missing_[lane] += value != value ? 1 : 0;  // NOLINT(misc-redundant-expression): NaN
  }

  TileRange range() const {
    TileRange all{*std::min_element(least_.begin(), least_.end()),
                  *std::max_element(greatest_.begin(), greatest_.end()), 0};
    for (const std::uint64_t count : missing_) all.missing += count;
    return all;
  }

 private:
  std::array<double, kLanes> least_, greatest_;
  std::array<std::uint64_t, kLanes> missing_{};
};

template <typename Real>
TileRange range_as(std::span<const std::byte> values) {
  Lanes<Real> lanes;
  const std::size_t count = values.size() / sizeof(Real);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes.add(lane, values.data() + (i + lane) * sizeof(Real));
  for (; i < count; ++i) lanes.add(0, values.data() + i * sizeof(Real));
  return lanes.range();
}

}  // namespace

TileRange range_of(std::span<const std::byte> values, std::size_t element) {
  PORTRAIT_CHECK(element == sizeof(double) || element == sizeof(float));
  return element == sizeof(double) ? range_as<double>(values) : range_as<float>(values);
}

StatusCounts status_counts_of(std::span<const std::byte> codes) {
  StatusCounts counts{};
  for (const std::byte code : codes)
    if (std::to_integer<std::size_t>(code) < counts.size()) ++counts[std::to_integer<std::size_t>(code)];
  return counts;
}

std::vector<double> range_summary(std::span<const std::byte> values, std::size_t element) {
  const TileRange range = range_of(values, element);
  return {range.least, range.greatest, static_cast<double>(range.missing)};
}

std::vector<double> status_summary(std::span<const std::byte> codes) {
  const StatusCounts counts = status_counts_of(codes);
  return {counts.begin(), counts.end()};
}

}  // namespace portrait
