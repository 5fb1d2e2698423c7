#include "portraits/writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/output_column.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"
#include "portraits/stored_grid.h"
#include "portraits/verify.h"

namespace portrait {
namespace {

/// For programs that know NeXus: what to plot over what.
void write_nexus(const h5::File& file, const Grid& grid) {
  if (grid.measures.empty()) return;
  file.set_text("NX_class", "NXdata");
  file.set_text("signal", std::string(to_string(grid.measures.front())));
  std::vector<std::string> axes;
  for (const Axis& axis : grid.axes) axes.emplace_back(axis.name());
  if (!axes.empty()) file.set_texts("axes", axes);
}

/// Every NaN becomes the same NaN: its sign and payload depend on the machine.
template <typename Real>
void write_as(OutputColumn& column, std::uint64_t tile, const std::vector<double>& values) {
  std::vector<Real> stored(values.size());
  std::transform(values.begin(), values.end(), stored.begin(), [](double value) {
    return std::isnan(value) ? std::numeric_limits<Real>::quiet_NaN() : static_cast<Real>(value);
  });
  column.write(tile, std::as_bytes(std::span(stored)));
}

/// The last chance to notice a disk that loses what it is given.
void check_readable(const TemporaryFile& written) {
  try {
    verify(written.path());
  } catch (const IntegrityError& error) {
    throw StoreError(fmt::format("{}: not published, for it does not read back as written: {}",
                                 written.target().string(), error.what()));
  }
}

}  // namespace

/// The open file with its columns.
class PortraitWriter::File {
 public:
  File(const std::filesystem::path& path, const Grid& grid)
      : grid_(grid), rows_(grid), file_(h5::File::create(path)), written_(rows_.tile_count(), false) {}
  ~File() {
    if (!closed_) abandon();
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  /// Everything but values. Not in the constructor: a file on which this fails must be abandoned too.
  void begin(const Provenance& provenance) {
    file_.set_text("Conventions", "CF-1.10");
    file_.set_text("title", grid_.title);
    write_provenance(file_, provenance);
    write_grid(file_, grid_);
    write_nexus(file_, grid_);
    for (const Measure measure : grid_.measures)
      measures_.push_back(OutputColumn::of_measure(file_, grid_, measure));
    status_.push_back(OutputColumn::of_status(file_, grid_));
  }

  void write(std::uint64_t tile, const MeasureColumns& columns) {
    PORTRAIT_CHECK(tile < written_.size() && !written_[tile]);
    PORTRAIT_CHECK(columns.kept == grid_.measures);
    PORTRAIT_CHECK_EQ(columns.settings(), rows_.range(tile).count);
    for (std::size_t k = 0; k < measures_.size(); ++k) write_values(measures_[k], tile, columns.values[k]);
    status_.front().write(tile, std::as_bytes(std::span(columns.status)));
    written_[tile] = true;
  }

  std::uint64_t tiles_left() const {
    return static_cast<std::uint64_t>(std::count(written_.begin(), written_.end(), false));
  }

  void finish(const RunFacts& facts) {
    PORTRAIT_CHECK_EQ(tiles_left(), std::uint64_t{0});
    const h5::Dataset scale = create_tile_scale();
    for (const OutputColumn& column : measures_) column.finish(file_, scale);
    status_.front().finish(file_, scale);
    write_run_facts(file_, facts);
    file_.close();
    closed_ = true;
  }

 private:
  void abandon() {
    try {
      file_.abandon();
    } catch (const StoreError&) {
      // The file is removed next; why it would not close is of no use to anyone.
    }
  }

  void write_values(OutputColumn& column, std::uint64_t tile, const std::vector<double>& values) {
    PORTRAIT_CHECK_EQ(values.size(), rows_.range(tile).count);
    if (grid_.precision == Precision::real64)
      write_as<double>(column, tile, values);
    else
      write_as<float>(column, tile, values);
  }

  h5::Dataset create_tile_scale() const {
    file_.create_group(schema::kTileDigests);
    std::vector<std::uint64_t> numbers(written_.size());
    for (std::uint64_t tile = 0; tile < numbers.size(); ++tile) numbers[tile] = tile;
    const h5::Dataset scale =
        file_.create_dataset(schema::tile_digests_of(schema::kTile), schema::tile_digest_layout(numbers.size()));
    write_plain(scale, numbers);
    scale.make_scale(schema::kTile);
    scale.set_text("long_name", "number of the tile, a chunk of each column, in row-major order");
    return scale;
  }

  Grid grid_;
  TileRows rows_;
  h5::File file_;
  std::vector<OutputColumn> measures_;
  std::vector<OutputColumn> status_;  ///< one
  std::vector<bool> written_;
  bool closed_ = false;
};

PortraitWriter::PortraitWriter(const std::filesystem::path& path, const Grid& grid, const Provenance& provenance,
                               Existing existing)
    : temporary_(path), existing_(existing) {
  check_target(path, existing);
  file_ = std::make_unique<File>(temporary_.path(), grid);
  file_->begin(provenance);
}

PortraitWriter::~PortraitWriter() = default;

void PortraitWriter::write(std::uint64_t tile, const MeasureColumns& columns) {
  PORTRAIT_CHECK(file_ != nullptr);
  file_->write(tile, columns);
}

std::uint64_t PortraitWriter::tiles_left() const { return file_ ? file_->tiles_left() : 0; }

void PortraitWriter::publish(const RunFacts& facts) {
  PORTRAIT_CHECK(file_ != nullptr);
  file_->finish(facts);
  file_.reset();
  check_readable(temporary_);
  temporary_.publish(existing_);
}

}  // namespace portrait
