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
      digests_(std::make_shared<const std::vector<std::uint64_t>>(read_digests(file, dataset_, rows))),
      held_(rows.tile_count()) {}

std::vector<double> StoredColumn::summaries(const h5::File& file, const std::string& name, std::size_t numbers,
                                            const TileRows& rows) {
  const std::string dataset = schema::tile_summaries_of(name);
  if (!file.contains(schema::kTileSummaries)) return {};
  std::vector<double> all = read_reals(file, dataset, 2);
  if (all.size() != rows.tile_count() * numbers)
    throw IntegrityError(fmt::format("{}: {} has not {} numbers per tile", file.origin().file, dataset, numbers));
  return all;
}

void StoredColumn::decode(std::uint64_t number) {
  const ChunkForm form = dataset_.read_chunk(rows_.box(number).start, next_);
  // Tiles that are all NaN, all zero, all settled follow each other: the same bytes decode to the same values.
  if (decoded_ && form == form_ && next_ == stored_) return;
  decoded_ = false;
  values_.resize(h5::Layout{dataset_.layout().element, dataset_.layout().chunk, {}}.bytes());
  const std::string_view problem = decode_chunk(next_, form, h5::size_of(dataset_.layout().element), values_);
  if (!problem.empty()) broken(dataset_, fmt::format("is damaged: the chunk of tile {} {}", number, problem));
  stored_.swap(next_);
  form_ = form;
  decoded_ = true;
}

void StoredColumn::read(std::uint64_t number) {
  if (!dataset_.layout().chunk.empty()) return decode(number);
  values_.resize(dataset_.layout().bytes());
  dataset_.read_all(values_.data());
}

std::span<const std::byte> StoredColumn::tile(std::uint64_t number) {
  const std::size_t size = rows_.range(number).count * h5::size_of(dataset_.layout().element);
  if (number == held_) return std::span(values_).first(size);
  held_ = rows_.tile_count();
  read(number);
  const auto values = std::span(values_).first(size);
  if (digest_of(values) != (*digests_)[number])
    broken(dataset_, fmt::format("holds other values than were written (the digest of tile {} differs)", number));
  held_ = number;
  return values;
}

}  // namespace portrait
