#include "tests/portraits/sample.h"

#include <limits>

#include "grids/tiling.h"
#include "portraits/tile_rows.h"

namespace portrait::sample {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::vector<double> rising(double from, std::uint64_t count) {
  std::vector<double> values(count);
  for (std::uint64_t i = 0; i < count; ++i) values[i] = from + 0.01 * static_cast<double>(i);
  return values;
}

Grid grid_with(std::vector<Axis> axes) {
  Grid grid{.title = "A sample",
            .family = {.plant = Plant::dipdt, .n = 1, .prefilter = Prefilter::full},
            .horizon = Horizon::fixed(51),
            .sampling = {},
            .precision = Precision::real64,
            .measures = {Measure::IAE_w, Measure::TV2_uw, Measure::Ms},
            .axes = std::move(axes),
            .fixed = {},
            .text = "plant = \"dipdt\"  # a grid file, byte for byte\n"};
  const std::vector<FixedParameter> all = {{Parameter::kappa, 0.24}, {Parameter::tau_i, 8}, {Parameter::delta, 0.7},
                                           {Parameter::tau_f, 0.1},  {Parameter::b, 0.5},   {Parameter::c, 0.25}};
  for (const FixedParameter& fixed : all) {
    bool is_axis = false;
    for (const Axis& axis : grid.axes) is_axis = is_axis || axis.parameter() == fixed.parameter;
    if (!is_axis) grid.fixed.push_back(fixed);
  }
  return grid;
}

/// The digests in portraits/FORMAT.md rest on it: it stays when a measure joins the catalogue.
int number_of(Measure measure) {
  if (measure == Measure::TV2_uw) return 10;
  if (measure == Measure::Ms) return 23;
  return static_cast<int>(measure) + 1;
}

}  // namespace

Grid small_grid() {
  return grid_with(
      {Axis::list(Parameter::kappa, {0.2, 0.24, 0.3}), Axis::list(Parameter::tau_i, {6, 8, 10, kInfinite})});
}

Grid grid_of(const std::vector<std::uint64_t>& sizes, Precision precision) {
  const std::vector<Parameter> parameters = {Parameter::kappa, Parameter::tau_i, Parameter::delta,
                                             Parameter::tau_f};
  std::vector<Axis> axes;
  for (std::size_t k = 0; k < sizes.size(); ++k)
    axes.push_back(Axis::list(parameters[k], rising(0.05 + static_cast<double>(k), sizes[k])));
  Grid grid = grid_with(std::move(axes));
  grid.precision = precision;
  return grid;
}

double value(Measure measure, std::uint64_t setting) {
  if (status(setting) == Status::unstable) return kNaN;
  const double x = static_cast<double>(setting);
  return static_cast<double>(number_of(measure)) + x + 1 / (x + 3);
}

Status status(std::uint64_t setting) {
  if (setting % 7 == 5) return Status::unstable;
  return setting % 3 == 1 ? Status::not_settled : Status::settled;
}

double repeating_value(Measure measure, std::uint64_t setting) {
  const std::uint64_t kind = setting / 4000 % 4, place = setting % 4000;
  if (kind == 0) return kNaN;
  if (kind == 1) return static_cast<double>(number_of(measure) - 1);
  return kind == 2 && place < 2400 ? 0.5 : value(measure, 7 * setting);
}

namespace {

template <typename ValueOf>
MeasureColumns columns_with(const Grid& grid, std::uint64_t tile, ValueOf value_of) {
  const SettingRange range = TileRows(grid).range(tile);
  MeasureColumns columns(grid.measures, range.count);
  for (std::uint64_t i = 0; i < range.count; ++i) {
    MeasureRow row;
    for (const Measure measure : grid.measures) row[measure] = value_of(measure, range.first + i);
    columns.set(i, status(range.first + i), row);
  }
  return columns;
}

}  // namespace

MeasureColumns columns(const Grid& grid, std::uint64_t tile) { return columns_with(grid, tile, value); }

MeasureColumns repeating_columns(const Grid& grid, std::uint64_t tile) {
  return columns_with(grid, tile, repeating_value);
}

void write(const std::filesystem::path& path, const Grid& grid, Existing existing, Columns columns_of) {
  PortraitWriter writer(path, grid, {.command_line = "portrait sweep sample.toml", .method = "sample"}, existing);
  for (std::uint64_t tile = 0; tile < Tiling(grid).tile_count(); ++tile)
    writer.write(writer.encode(tile, columns_of(grid, tile)));
  writer.publish({.wall_seconds = 1.5, .threads = 2});
}

}  // namespace portrait::sample
