#include "portraits/encoded_tile.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/base/check.h"
#include "engine/base/clones.h"
#include "portraits/chunk_codec.h"
#include "portraits/digest.h"
#include "portraits/tile_summary.h"

namespace portrait {
namespace {

std::size_t chunk_values(const TileRows& rows) {
  std::size_t count = 1;
  for (const std::uint64_t extent : rows.tile_extent()) count *= extent;
  return count;
}

/// Every NaN becomes the same NaN: its sign and payload depend on the machine.
template <typename Real>
[[gnu::always_inline]] inline void convert_as(const double* from, std::size_t count, std::byte* into) {
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (std::size_t i = 0; i < count; ++i) {
    Real value = static_cast<Real>(from[i]);
    value = value != value ? nan : value;  // NOLINT(misc-redundant-expression): std::isnan stays out of vector code
    std::memcpy(into + i * sizeof(Real), &value, sizeof(Real));
  }
}

PORTRAIT_CLONES void convert_to_double(const double* from, std::size_t count, std::byte* into) {
  convert_as<double>(from, count, into);
}

PORTRAIT_CLONES void convert_to_float(const double* from, std::size_t count, std::byte* into) {
  convert_as<float>(from, count, into);
}

/// The chunks of a tile, one behind the other, each made where it stays.
class ChunkRow {
 public:
  ChunkRow(const Grid& grid, std::size_t chunk_values)
      : precision_(grid.precision), chunk_values_(chunk_values) {
    const std::size_t largest = chunk_values * sizeof(double) + kChecksumBytes;
    memory_ = page_memory((grid.measures.size() + 1) * largest);
    next_ = memory_.get();
  }

  void add(const std::vector<double>& values) {
    const bool twice = precision_ == Precision::real64;
    const std::size_t element = twice ? sizeof(double) : sizeof(float);
    const auto convert = twice ? convert_to_double : convert_to_float;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    convert(values.data(), values.size(), next_);
    convert(&nan, 1, fill_);
    const std::span written(next_, values.size() * element);
    finish(written, element, range_summary(written, element));
  }

  void add(const std::vector<Status>& status) {
    const std::span written(next_, status.size());
    std::copy_n(std::as_bytes(std::span(status)).begin(), status.size(), written.begin());
    fill_[0] = std::byte{0};
    finish(written, 1, status_summary(written));
  }

  EncodedTile tile(std::uint64_t number) {
    const std::span<const std::byte> all(memory_.get(), next_);
    const std::uint64_t digest = digest_of(all);
    return {{.number = number, .stored_digest = digest, .chunks = std::move(chunks_)},
            {std::move(memory_), all.size(), digest}};
  }

 private:
  /// Of the values at `next_`: pads them to a whole chunk, deflates that where it pays, and appends the checksum.
  void finish(std::span<const std::byte> values, std::size_t element, std::vector<double> summary) {
    ChunkRecord record{.digest = digest_of(values), .summary = std::move(summary)};
    const std::span chunk(next_, chunk_values_ * element);
    PORTRAIT_CHECK(values.size() <= chunk.size());
    for (std::size_t at = values.size(); at < chunk.size(); at += element) std::copy_n(fill_, element, &chunk[at]);
    std::vector<std::byte> deflated;
    if (repeats(chunk, element)) deflated = deflated_chunk(chunk, element);
    if (deflated.empty() || deflated.size() >= chunk.size()) {  // the latter: a chunk of few values
      const std::array checksum = checksum_of(chunk);
      std::copy(checksum.begin(), checksum.end(), chunk.data() + chunk.size());
      record.length = chunk.size() + checksum.size();
    } else {
      std::copy(deflated.begin(), deflated.end(), next_);
      record.length = deflated.size();
      record.form = ChunkForm::deflated;
    }
    next_ += record.length;
    chunks_.push_back(std::move(record));
  }

  Precision precision_;
  std::size_t chunk_values_;
  PageMemory memory_;
  std::byte* next_ = nullptr;
  std::byte fill_[sizeof(double)] = {};  ///< the value that pads the column in hand
  std::vector<ChunkRecord> chunks_;
};

}  // namespace

EncodedTile encode_tile(const Grid& grid, const TileRows& rows, std::uint64_t tile, const MeasureColumns& columns) {
  PORTRAIT_CHECK(tile < rows.tile_count());
  PORTRAIT_CHECK(columns.kept == grid.measures);
  PORTRAIT_CHECK_EQ(columns.settings(), rows.range(tile).count);
  ChunkRow row(grid, chunk_values(rows));
  for (const std::vector<double>& values : columns.values) {
    PORTRAIT_CHECK_EQ(values.size(), columns.settings());
    row.add(values);
  }
  row.add(columns.status);
  return row.tile(tile);
}

}  // namespace portrait
