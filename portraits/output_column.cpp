#include "portraits/output_column.h"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/status.h"
#include "portraits/digest.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"
#include "portraits/stored_grid.h"

namespace portrait {
namespace {

/// CF: where the values of parameters without an axis are.
void name_fixed_coordinates(const h5::Dataset& dataset, const Grid& grid) {
  if (grid.fixed.empty()) return;
  std::vector<std::string_view> names;
  for (const FixedParameter& fixed : grid.fixed) names.push_back(to_string(fixed.parameter));
  dataset.set_text("coordinates", schema::names_text(names));
}

h5::Dataset create_column(const h5::File& file, const Grid& grid, const std::string& name, h5::Element element) {
  const h5::Dataset dataset = file.create_dataset(name, schema::column_layout(TileRows(grid), element));
  attach_axes(file, dataset, grid);
  return dataset;
}

}  // namespace

OutputColumn::OutputColumn(h5::Dataset dataset, const Grid& grid)
    : dataset_(std::move(dataset)), rows_(grid), digests_(rows_.tile_count()) {}

OutputColumn OutputColumn::of_measure(const h5::File& file, const Grid& grid, Measure measure) {
  const MeasureInfo& about = info(measure);
  const h5::Element element = schema::element_of(grid.precision);
  const h5::Dataset dataset = create_column(file, grid, std::string(about.name), element);
  dataset.set_text("units", "1");
  dataset.set_text("long_name", std::string(about.long_name));
  dataset.set_text("definition", std::string(about.definition));
  dataset.set_text("step", std::string(1, about.step));
  dataset.set_real("_FillValue", std::numeric_limits<double>::quiet_NaN(), element);
  name_fixed_coordinates(dataset, grid);
  return {dataset, grid};
}

// No attribute _FillValue: 0 has a meaning here, and readers would turn the column into reals to mask it.
OutputColumn OutputColumn::of_status(const h5::File& file, const Grid& grid) {
  const h5::Dataset dataset = create_column(file, grid, schema::kStatus, h5::Element::uint8);
  std::vector<std::uint8_t> values(kStatusNames.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint8_t>(i);
  dataset.set_text("long_name", "outcome of the setting");
  dataset.set_bytes("flag_values", values);
  dataset.set_text("flag_meanings", schema::names_text({kStatusNames.begin(), kStatusNames.end()}));
  name_fixed_coordinates(dataset, grid);
  return {dataset, grid};
}

void OutputColumn::write(std::uint64_t tile, std::span<const std::byte> bytes) {
  const Box box = rows_.box(tile);
  dataset_.write(box.start, box.extent, bytes.data());
  digests_[tile] = digest_of(bytes);
}

std::uint64_t OutputColumn::read_back() const {
  Digest whole;
  std::vector<std::byte> bytes;
  for (std::uint64_t tile = 0; tile < digests_.size(); ++tile) {
    const Box box = rows_.box(tile);
    bytes.resize(box.size() * h5::size_of(dataset_.layout().element));
    dataset_.read(box.start, box.extent, bytes.data());
    if (digest_of(bytes) != digests_[tile])
      throw StoreError(fmt::format("{}: {} does not hold what was written to tile {}", dataset_.origin().file,
                                   dataset_.name(), tile));
    whole.add(bytes);
  }
  return whole.value();
}

void OutputColumn::finish(const h5::File& file, const h5::Dataset& tile_scale) const {
  dataset_.set_text(schema::kDigest, digest_text(read_back()));
  const h5::Dataset stored =
      file.create_dataset(schema::tile_digests_of(dataset_.name()), schema::tile_digest_layout(digests_.size()));
  write_plain(stored, digests_);
  stored.attach_scale(0, tile_scale, schema::kTile);
  stored.set_text("long_name", fmt::format("XXH3 of each tile of {}", dataset_.name()));
}

}  // namespace portrait
