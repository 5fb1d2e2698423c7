#include "portraits/output_column.h"

#include <limits>
#include <numeric>
#include <span>
#include <string>

#include <fmt/format.h>

#include "engine/base/status.h"
#include "portraits/plain_dataset.h"
#include "portraits/schema.h"
#include "portraits/tile_summary.h"
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

/// A dimension without values of its own: 0, 1, 2, ...
h5::Dataset create_scale(const h5::File& file, const std::string& name, const char* dimension, std::uint64_t size,
                         const char* long_name) {
  std::vector<std::uint64_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
  const h5::Dataset scale = file.create_dataset(name, schema::tile_digest_layout(size));
  write_plain(scale, numbers);
  scale.make_scale(dimension);
  scale.set_text("long_name", long_name);
  return scale;
}

}  // namespace

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
  return OutputColumn(dataset);
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
  return OutputColumn(dataset);
}

void OutputColumn::enter(const std::vector<std::uint64_t>& start, const ChunkRecord& chunk, std::uint64_t address) {
  if (dataset_.layout().chunk.empty())
    dataset_.copy_from(address);
  else
    dataset_.place_chunk(start, {address, chunk.length, chunk.form});
  digests_.push_back(chunk.digest);
  summaries_.insert(summaries_.end(), chunk.summary.begin(), chunk.summary.end());
}

OutputColumn::TileScales OutputColumn::create_tile_scales(const h5::File& file, std::uint64_t tiles) {
  file.create_group(schema::kTileDigests);
  file.create_group(schema::kTileSummaries);
  const char* const tile = "number of the tile, a chunk of each column, in row-major order";
  return {create_scale(file, schema::tile_digests_of(schema::kTile), schema::kTile, tiles, tile),
          create_scale(file, schema::tile_summaries_of(schema::kTile), schema::kTile, tiles, tile),
          create_scale(file, schema::tile_summaries_of(schema::kRange), schema::kRange, kRangeNumbers,
                       "0: least value, 1: greatest value, 2: number of NaN"),
          create_scale(file, schema::tile_summaries_of(schema::kOutcome), schema::kOutcome, kStatusNames.size(),
                       "value of status")};
}

void OutputColumn::finish(const h5::File& file, const TileScales& scales) const {
  dataset_.set_text(schema::kDigest, digest_text(digest_of(std::as_bytes(std::span(digests_)))));
  const h5::Dataset digests =
      file.create_dataset(schema::tile_digests_of(dataset_.name()), schema::tile_digest_layout(digests_.size()));
  write_plain(digests, digests_);
  digests.attach_scale(0, scales.digests, schema::kTile);
  digests.set_text("long_name", fmt::format("XXH3 of each tile of {}", dataset_.name()));
  finish_summaries(file, scales);
}

void OutputColumn::finish_summaries(const h5::File& file, const TileScales& scales) const {
  const bool is_status = dataset_.name() == schema::kStatus;
  const std::uint64_t tiles = digests_.size();
  const h5::Dataset summaries = file.create_dataset(schema::tile_summaries_of(dataset_.name()),
                                                    schema::tile_summary_layout(tiles, summaries_.size() / tiles));
  write_plain(summaries, summaries_);
  summaries.attach_scale(0, scales.tile, schema::kTile);
  summaries.attach_scale(1, is_status ? scales.outcome : scales.range,
                         is_status ? schema::kOutcome : schema::kRange);
  summaries.set_text("long_name", is_status ? "settings of each tile with each status"
                                            : fmt::format("range of {} in each tile", dataset_.name()));
}

}  // namespace portrait
