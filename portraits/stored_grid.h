/// A grid as a portrait keeps it: the root's attributes, a dataset per axis and per fixed parameter.
#pragma once

#include "grids/grid.h"
#include "portraits/h5.h"

namespace portrait {

/// Writes the grid and gives back nothing to remember: columns find their scales by name.
void write_grid(const h5::File& file, const Grid& grid);

/// The same grid, values bit for bit, every axis as a list. Throws IntegrityError where the file does not
/// hold one.
Grid read_grid(const h5::File& file);

/// Gives a column the grid's axes as dimension scales. REQUIRES: write_grid was called.
void attach_axes(const h5::File& file, const h5::Dataset& column, const Grid& grid);

}  // namespace portrait
