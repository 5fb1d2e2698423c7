#include "portraits/stored_column.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "portraits/digest.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"

namespace portrait {
namespace {

[[noreturn]] void broken(const h5::Dataset& dataset, const std::string& what) {
  throw IntegrityError(fmt::format("{}: {} {}", dataset.origin().file, dataset.name(), what));
}

h5::Dataset open_as(const h5::File& file, const std::string& name, const h5::Layout& layout) {
  h5::Dataset dataset = file.dataset(name);
  if (dataset.layout() != layout) broken(dataset, "has another type or shape than the grid asks for");
  return dataset;
}

std::vector<std::uint64_t> read_digests(const h5::File& file, const h5::Dataset& column, const TileRows& rows) {
  std::vector<std::uint64_t> digests = read_row_of_uint64(file, schema::tile_digests_of(column.name()));
  if (digests.size() != rows.tile_count()) broken(column, "has not one digest per tile");
  return digests;
}

}  // namespace

StoredColumn::StoredColumn(const h5::File& file, const std::string& name, h5::Element element, const TileRows& rows)
    : dataset_(open_as(file, name, schema::column_layout(rows, element))),
      rows_(rows),
      digests_(read_digests(file, dataset_, rows)),
      held_(rows.tile_count()) {}

std::span<const std::byte> StoredColumn::tile(std::uint64_t number) {
  if (number == held_) return bytes_;
  const Box box = rows_.box(number);
  held_ = rows_.tile_count();
  bytes_.resize(box.size() * h5::size_of(dataset_.layout().element));
  dataset_.read(box.start, box.extent, bytes_.data());
  if (digest_of(bytes_) != digests_[number])
    broken(dataset_, fmt::format("holds other values than were written (the digest of tile {} differs)", number));
  held_ = number;
  return bytes_;
}

}  // namespace portrait
