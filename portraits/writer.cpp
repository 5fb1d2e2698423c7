#include "portraits/writer.h"

#include "engine/base/check.h"
#include "portraits/finished_portrait.h"

namespace portrait {

TileRecord append_tile(DataFile& file, EncodedTile tile) {
  tile.record.address = file.end();
  file.append(std::move(tile.chunks));
  return std::move(tile.record);
}

PortraitWriter::PortraitWriter(const std::filesystem::path& path, const Grid& grid, const Provenance& provenance,
                               Existing existing)
    : temporary_(path), existing_(existing), grid_(grid), rows_(grid), provenance_(provenance) {
  check_target(path, existing);
  if (provenance_.date.empty()) provenance_.date = date_text();
  data_ = DataFile::create(temporary_.path());
}

EncodedTile PortraitWriter::encode(std::uint64_t tile, const MeasureColumns& columns) const {
  return encode_tile(grid_, rows_, tile, columns);
}

void PortraitWriter::write(EncodedTile tile) {
  PORTRAIT_CHECK(data_ != nullptr);
  PORTRAIT_CHECK(tile.record.number == tiles_.size() && tiles_left() > 0);
  PORTRAIT_CHECK_EQ(tile.record.chunks.size(), grid_.measures.size() + 1);
  tiles_.push_back(append_tile(*data_, std::move(tile)));
}

void PortraitWriter::publish(const RunFacts& facts) {
  PORTRAIT_CHECK(data_ != nullptr);
  PORTRAIT_CHECK_EQ(tiles_left(), std::uint64_t{0});
  const std::uint64_t end = data_->commit();
  data_.reset();
  finish_portrait(temporary_.path(), end, grid_, provenance_, facts, tiles_);
  temporary_.publish(existing_);
}

}  // namespace portrait
