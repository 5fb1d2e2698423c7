#include "portraits/output_column.h"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "engine/base/status.h"
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

void OutputColumn::write(const std::vector<std::uint64_t>& start, const EncodedColumn& column) {
  if (dataset_.layout().chunk.empty())
    dataset_.write_all(column.values().data());
  else
    dataset_.write_chunk(start, column.form(), column.stored());
  whole_.add(column.values());
  digests_.push_back(column.digest());
}

void OutputColumn::finish(const h5::File& file, const h5::Dataset& tile_scale) const {
  dataset_.set_text(schema::kDigest, digest_text(whole_.value()));
  const h5::Dataset stored =
      file.create_dataset(schema::tile_digests_of(dataset_.name()), schema::tile_digest_layout(digests_.size()));
  write_plain(stored, digests_);
  stored.attach_scale(0, tile_scale, schema::kTile);
  stored.set_text("long_name", fmt::format("XXH3 of each tile of {}", dataset_.name()));
}

}  // namespace portrait
