#include "portraits/tile_summary.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/base/check.h"
#include "engine/base/clones.h"

namespace portrait {
namespace {

constexpr std::size_t kLanes = 8;  ///< chains of comparisons side by side

/// Vectors of the compiler, whatever registers there are.
template <typename Number>
struct VectorOf {
  using Type [[gnu::vector_size(kLanes * sizeof(Number))]] = Number;
};
using Doubles = VectorOf<double>::Type;
using Counts = VectorOf<std::int64_t>::Type;

template <typename Real>
[[gnu::always_inline]] inline void widen(const std::byte* from, Doubles& values) {
  typename VectorOf<Real>::Type stored;
  std::memcpy(&stored, from, sizeof stored);
  values = __builtin_convertvector(stored, Doubles);
}

/// NaN is in no comparison, so it changes neither bound.
struct LaneRange {
  Doubles least = std::numeric_limits<double>::infinity() - Doubles{};
  Doubles greatest = Doubles{} - std::numeric_limits<double>::infinity();
  Counts missing{};

  [[gnu::always_inline]] void add(const Doubles& value) {
    least = value < least ? value : least;
    greatest = value > greatest ? value : greatest;
    missing -= value != value;  // NOLINT(misc-redundant-expression): NaN; what is true is -1
  }
};

void take(TileRange& range, const LaneRange& lanes) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    range.least = std::min(range.least, lanes.least[lane]);
    range.greatest = std::max(range.greatest, lanes.greatest[lane]);
    range.missing += static_cast<std::uint64_t>(lanes.missing[lane]);
  }
}

void take(TileRange& range, double value) {
  if (value != value) ++range.missing;  // NOLINT(misc-redundant-expression): NaN
  range.least = value < range.least ? value : range.least;
  range.greatest = value > range.greatest ? value : range.greatest;
}

/// Two rows of lanes, since a comparison waits for the one before it.
template <typename Real>
[[gnu::always_inline]] inline TileRange range_as(std::span<const std::byte> values) {
  LaneRange even, odd;
  constexpr std::size_t row = kLanes * sizeof(Real);
  std::size_t at = 0;
  for (; at + 2 * row <= values.size(); at += 2 * row) {
    Doubles here, next;
    widen<Real>(values.data() + at, here);
    widen<Real>(values.data() + at + row, next);
    even.add(here);
    odd.add(next);
  }
  TileRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0};
  take(range, even);
  take(range, odd);
  for (; at < values.size(); at += sizeof(Real)) {
    Real stored;
    std::memcpy(&stored, values.data() + at, sizeof stored);
    take(range, static_cast<double>(stored));
  }
  return range;
}

PORTRAIT_CLONES TileRange range_of_doubles(std::span<const std::byte> values) { return range_as<double>(values); }
PORTRAIT_CLONES TileRange range_of_floats(std::span<const std::byte> values) { return range_as<float>(values); }

}  // namespace

TileRange range_of(std::span<const std::byte> values, std::size_t element) {
  PORTRAIT_CHECK(element == sizeof(double) || element == sizeof(float));
  return element == sizeof(double) ? range_of_doubles(values) : range_of_floats(values);
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
