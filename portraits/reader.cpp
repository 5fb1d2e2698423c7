#include "portraits/reader.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/open_portrait.h"
#include "portraits/schema.h"
#include "portraits/stored_column.h"
#include "portraits/stored_grid.h"

namespace portrait {
namespace {

/// Bytes as stored to doubles. Through memcpy: a span of bytes need not be aligned.
template <typename Real>
void widen(std::span<const std::byte> bytes, double* into) {
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Real)) {
    Real value;
    std::memcpy(&value, bytes.data() + at, sizeof(Real));
    *into++ = static_cast<double>(value);
  }
}

Status status_of(std::byte code, const std::filesystem::path& path) {
  if (std::to_integer<std::size_t>(code) >= kStatusNames.size())
    throw IntegrityError(
        fmt::format("{}: status holds {}, which has no meaning", path.string(), std::to_integer<int>(code)));
  return static_cast<Status>(code);
}

}  // namespace

/// The open file, its columns opened when first asked for.
class PortraitReader::File {
 public:
  explicit File(const std::filesystem::path& path)
      : path_(path), file_(open_portrait(path)), grid_(read_grid(file_)), facts_(read_facts(file_)), rows_(grid_) {}

  const std::filesystem::path& path() const { return path_; }
  const Grid& grid() const { return grid_; }
  const Facts& facts() const { return facts_; }

  StoredColumn& measure(Measure measure) {
    auto& column = measures_[static_cast<std::size_t>(measure)];
    if (!column) column.emplace(file_, std::string(to_string(measure)), schema::element_of(grid_.precision), rows_);
    return *column;
  }

  std::vector<TileRange> ranges(Measure measure) const {
    const std::vector<double> numbers =
        StoredColumn::summaries(file_, std::string(to_string(measure)), kRangeNumbers, rows_);
    std::vector<TileRange> ranges;
    ranges.reserve(numbers.size() / kRangeNumbers);
    for (std::size_t at = 0; at < numbers.size(); at += kRangeNumbers)
      ranges.push_back({numbers[at], numbers[at + 1], static_cast<std::uint64_t>(numbers[at + 2])});
    return ranges;
  }

  std::vector<StatusCounts> status_counts() const {
    constexpr std::size_t kOutcomes = StatusCounts{}.size();
    const std::vector<double> numbers = StoredColumn::summaries(file_, schema::kStatus, kOutcomes, rows_);
    std::vector<StatusCounts> counts(numbers.size() / kOutcomes);
    for (std::size_t at = 0; at < numbers.size(); ++at)
      counts[at / kOutcomes][at % kOutcomes] = static_cast<std::uint64_t>(numbers[at]);
    return counts;
  }

  StoredColumn& status() {
    if (!status_) status_.emplace(file_, schema::kStatus, h5::Element::uint8, rows_);
    return *status_;
  }

 private:
  std::filesystem::path path_;
  h5::File file_;
  Grid grid_;
  Facts facts_;
  TileRows rows_;
  std::array<std::optional<StoredColumn>, kMeasureCount> measures_;
  std::optional<StoredColumn> status_;
};

PortraitReader::PortraitReader(const std::filesystem::path& path) : file_(std::make_unique<File>(path)) {}
PortraitReader::PortraitReader(std::unique_ptr<File> file) : file_(std::move(file)) {}
PortraitReader::~PortraitReader() = default;
PortraitReader::PortraitReader(PortraitReader&&) noexcept = default;
PortraitReader& PortraitReader::operator=(PortraitReader&&) noexcept = default;

const std::filesystem::path& PortraitReader::path() const { return file_->path(); }
const Grid& PortraitReader::grid() const { return file_->grid(); }
const Facts& PortraitReader::facts() const { return file_->facts(); }

bool PortraitReader::has(Measure measure) const {
  const std::vector<Measure>& kept = grid().measures;
  return std::find(kept.begin(), kept.end(), measure) != kept.end();
}

void PortraitReader::read(Measure measure, std::uint64_t first, std::size_t count,
                          std::vector<double>& values) const {
  PORTRAIT_CHECK(has(measure));
  PORTRAIT_CHECK(first <= settings() && count <= settings() - first);
  values.resize(count);
  const auto widen_stored = grid().precision == Precision::real64 ? widen<double> : widen<float>;
  file_->measure(measure).for_each_piece({first, count}, [&](std::span<const std::byte> bytes, std::uint64_t at) {
    widen_stored(bytes, values.data() + (at - first));
  });
}

std::vector<TileRange> PortraitReader::tile_ranges(Measure measure) const {
  PORTRAIT_CHECK(has(measure));
  return file_->ranges(measure);
}

std::vector<StatusCounts> PortraitReader::tile_status_counts() const { return file_->status_counts(); }

std::unique_ptr<ColumnSource> PortraitReader::for_another_thread() const {
  return std::unique_ptr<ColumnSource>(new PortraitReader(std::make_unique<File>(*file_)));
}

void PortraitReader::read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const {
  PORTRAIT_CHECK(first <= settings() && count <= settings() - first);
  statuses.resize(count);
  file_->status().for_each_piece({first, count}, [&](std::span<const std::byte> bytes, std::uint64_t at) {
    for (std::size_t i = 0; i < bytes.size(); ++i) statuses[at - first + i] = status_of(bytes[i], path());
  });
}

}  // namespace portrait
