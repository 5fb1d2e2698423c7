#include "portraits/writer.h"

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

/// The last chance to notice a disk that loses what it is given.
void check_readable(const TemporaryFile& written, int threads) {
  try {
    verify(written.path(), threads);
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
      : grid_(grid), rows_(grid), file_(h5::File::create(path)) {}
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

  EncodedTile encode(std::uint64_t tile, const MeasureColumns& columns) const {
    return encode_tile(grid_, rows_, tile, columns);
  }

  void write(const EncodedTile& tile) {
    PORTRAIT_CHECK(tile.number == written_ && written_ < rows_.tile_count());
    PORTRAIT_CHECK_EQ(tile.measures.size(), measures_.size());
    const std::vector<std::uint64_t> start = rows_.box(tile.number).start;
    for (std::size_t k = 0; k < measures_.size(); ++k) measures_[k].write(start, tile.measures[k]);
    status_.front().write(start, tile.status);
    ++written_;
  }

  std::uint64_t tiles_left() const { return rows_.tile_count() - written_; }

  void finish(const RunFacts& facts) {
    PORTRAIT_CHECK_EQ(tiles_left(), std::uint64_t{0});
    const OutputColumn::TileScales scales = OutputColumn::create_tile_scales(file_, written_);
    for (const OutputColumn& column : measures_) column.finish(file_, scales);
    status_.front().finish(file_, scales);
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

  Grid grid_;
  TileRows rows_;
  h5::File file_;
  std::vector<OutputColumn> measures_;
  std::vector<OutputColumn> status_;  ///< one
  std::uint64_t written_ = 0;         ///< tiles
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

EncodedTile PortraitWriter::encode(std::uint64_t tile, const MeasureColumns& columns) const {
  PORTRAIT_CHECK(file_ != nullptr);
  return file_->encode(tile, columns);
}

void PortraitWriter::write(const EncodedTile& tile) {
  PORTRAIT_CHECK(file_ != nullptr);
  file_->write(tile);
}

std::uint64_t PortraitWriter::tiles_left() const { return file_ ? file_->tiles_left() : 0; }

void PortraitWriter::publish(const RunFacts& facts) {
  PORTRAIT_CHECK(file_ != nullptr);
  file_->finish(facts);
  file_.reset();
  check_readable(temporary_, facts.threads);
  temporary_.publish(existing_);
}

}  // namespace portrait
