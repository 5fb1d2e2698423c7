#include "tests/portraits/sample.h"

#include <limits>
#include <numeric>

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

MeasureColumns columns(const Grid& grid, std::uint64_t tile) {
  const SettingRange range = TileRows(grid).range(tile);
  MeasureColumns columns(grid.measures, range.count);
  for (std::uint64_t i = 0; i < range.count; ++i) {
    MeasureRow row;
    for (const Measure measure : grid.measures) row[measure] = value(measure, range.first + i);
    columns.set(i, status(range.first + i), row);
  }
  return columns;
}

void write(const std::filesystem::path& path, const Grid& grid, const std::vector<std::uint64_t>& order,
           Existing existing) {
  PortraitWriter writer(path, grid, {.command_line = "portrait sweep sample.toml", .method = "sample"}, existing);
  for (const std::uint64_t tile : order) writer.write(tile, columns(grid, tile));
  writer.publish({.wall_seconds = 1.5, .threads = 2});
}

void write(const std::filesystem::path& path, const Grid& grid) { write(path, grid, tiles_in_order(grid)); }

std::vector<std::uint64_t> tiles_in_order(const Grid& grid) {
  std::vector<std::uint64_t> order(Tiling(grid).tile_count());
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  return order;
}

}  // namespace portrait::sample
