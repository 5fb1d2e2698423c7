#include "portraits/encoded_tile.h"

#include <cstring>
#include <limits>

#include "engine/base/check.h"
#include "portraits/digest.h"

namespace portrait {
namespace {

std::size_t chunk_values(const TileRows& rows) {
  std::size_t count = 1;
  for (const std::uint64_t extent : rows.tile_extent()) count *= extent;
  return count;
}

/// Every NaN becomes the same NaN: its sign and payload depend on the machine.
template <typename Real>
EncodedColumn encode_as(const std::vector<double>& values, std::size_t chunk_values) {
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  std::vector<std::byte> bytes;
  bytes.reserve(chunk_values * sizeof(Real) + kChecksumBytes);
  bytes.resize(values.size() * sizeof(Real));
  const double* from = values.data();
  std::byte* into = bytes.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    Real value = static_cast<Real>(from[i]);
    value = value != value ? nan : value;  // NOLINT(misc-redundant-expression): std::isnan stays out of vector code
    std::memcpy(into + i * sizeof(Real), &value, sizeof(Real));
  }
  std::vector<double> summary = range_summary(bytes, sizeof(Real));
  return {std::move(bytes), std::move(summary), std::as_bytes(std::span(&nan, 1)), chunk_values};
}

EncodedColumn encode_status(const std::vector<Status>& status, std::size_t chunk_values) {
  const auto bytes = std::as_bytes(std::span(status));
  constexpr std::byte fill{0};
  return {{bytes.begin(), bytes.end()}, status_summary(bytes), std::span(&fill, 1), chunk_values};
}

}  // namespace

EncodedColumn::EncodedColumn(std::vector<std::byte> values, std::vector<double> summary,
                             std::span<const std::byte> fill, std::size_t chunk_values)
    : plain_(std::move(values)),
      value_bytes_(plain_.size()),
      digest_(digest_of(plain_)),
      summary_(std::move(summary)) {
  const std::size_t chunk_bytes = chunk_values * fill.size();
  PORTRAIT_CHECK(value_bytes_ <= chunk_bytes);
  while (plain_.size() < chunk_bytes) plain_.insert(plain_.end(), fill.begin(), fill.end());
  if (repeats(plain_, fill.size())) deflated_ = deflated_chunk(plain_, fill.size());
  if (deflated_.size() >= chunk_bytes) deflated_.clear();  // a chunk of few values
  append_checksum(plain_);
}

EncodedTile encode_tile(const Grid& grid, const TileRows& rows, std::uint64_t tile, const MeasureColumns& columns) {
  PORTRAIT_CHECK(tile < rows.tile_count());
  PORTRAIT_CHECK(columns.kept == grid.measures);
  PORTRAIT_CHECK_EQ(columns.settings(), rows.range(tile).count);
  const std::size_t whole = chunk_values(rows);
  EncodedTile encoded{tile, {}, encode_status(columns.status, whole)};
  encoded.measures.reserve(columns.values.size());
  for (const std::vector<double>& values : columns.values) {
    PORTRAIT_CHECK_EQ(values.size(), columns.settings());
    encoded.measures.push_back(grid.precision == Precision::real64 ? encode_as<double>(values, whole)
                                                                   : encode_as<float>(values, whole));
  }
  Digest stored;
  for (const EncodedColumn& column : encoded.measures) stored.add(column.stored());
  stored.add(encoded.status.stored());
  encoded.stored_digest = stored.value();
  return encoded;
}

}  // namespace portrait
