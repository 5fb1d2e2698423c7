/// One column of a portrait file being read: a measure or the status, tile by tile, each tile held against
/// its digest.
///
/// A tile whose bytes are not those that were written throws IntegrityError, whatever the damage: to the
/// values, to HDF5's index of chunks (which has no checksum of its own), or to the digest.
///
/// cost      one tile and one digest per tile of memory; reading row-major decodes each tile once
/// threads   one at a time; a copy is for another one, and shares the digests
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "portraits/h5.h"
#include "portraits/tile_rows.h"

namespace portrait {

class StoredColumn {
 public:
  /// Opens the column and checks its type, shape and tile digests.
  StoredColumn(const h5::File& file, const std::string& name, h5::Element element, const TileRows& rows);

  /// The values of a tile as stored, until the next call.
  std::span<const std::byte> tile(std::uint64_t number);

  /// Calls use(bytes, first setting) for the tiles that hold these settings, in order, cut to them.
  template <typename Use>
  void for_each_piece(SettingRange wanted, Use use);

  /// What tile_summary.h keeps of each tile, one after the other; empty in a file of format 1.1 or before.
  static std::vector<double> summaries(const h5::File& file, const std::string& name, std::size_t numbers,
                                       const TileRows& rows);

  const h5::Dataset& dataset() const { return dataset_; }
  std::uint64_t digest(std::uint64_t number) const { return (*digests_)[number]; }  ///< of a tile, as the file says

 private:
  void read(std::uint64_t number);
  void decode(std::uint64_t number);

  h5::Dataset dataset_;
  TileRows rows_;
  std::shared_ptr<const std::vector<std::uint64_t>> digests_;
  std::vector<std::byte> values_;      ///< of a whole chunk
  std::vector<std::byte> stored_;      ///< the chunk they were decoded from
  std::vector<std::byte> next_;        ///< the chunk read last
  std::uint64_t held_;                 ///< the tile in values_, or tile_count
  bool decoded_ = false;               ///< values_ are those of stored_
  ChunkForm form_ = ChunkForm::plain;  ///< of stored_
};

template <typename Use>
void StoredColumn::for_each_piece(SettingRange wanted, Use use) {
  const std::size_t size = h5::size_of(dataset_.layout().element);
  for (std::uint64_t next = wanted.first; next < wanted.end();) {
    const std::uint64_t number = rows_.tile_of(next);
    const SettingRange range = rows_.range(number);
    const std::uint64_t stop = range.end() < wanted.end() ? range.end() : wanted.end();
    use(tile(number).subspan((next - range.first) * size, (stop - next) * size), next);
    next = stop;
  }
}

}  // namespace portrait
