/// Portraits to test with: small grids, and values that are a plain function of the setting's number.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/measures/columns.h"
#include "grids/grid.h"
#include "portraits/writer.h"

namespace portrait::sample {

/// kappa x tau_i with a last tau_i of inf; measures IAE_w, TV2_uw, Ms; b and c fixed.
Grid small_grid();
/// The same with `sizes` values along kappa, tau_i, delta, tau_f.
Grid grid_of(const std::vector<std::uint64_t>& sizes, Precision precision = Precision::real64);

/// Different for every setting and measure, the same on every machine; every seventh setting is unstable, NaN in
/// all measures.
double value(Measure measure, std::uint64_t setting);
Status status(std::uint64_t setting);

/// One that repeats: four thousand settings NaN, as many constant, as many mostly constant, as many different.
double repeating_value(Measure measure, std::uint64_t setting);

/// What a sweep would give for a tile.
MeasureColumns columns(const Grid& grid, std::uint64_t tile);

MeasureColumns repeating_columns(const Grid& grid, std::uint64_t tile);

/// All tiles, published with fixed run facts.
using Columns = MeasureColumns(const Grid& grid, std::uint64_t tile);
void write(const std::filesystem::path& path, const Grid& grid, Existing existing = Existing::refuse,
           Columns columns_of = columns);

}  // namespace portrait::sample
