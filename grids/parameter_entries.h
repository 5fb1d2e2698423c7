/// The table [parameters] of a grid file: which parameters a grid has, as axes and as fixed values.
#pragma once

#include "grids/document.h"
#include "grids/grid.h"

namespace portrait {

/// Sets `axes` and `fixed` of a grid whose family is known.
/// throws    InputError for a parameter that is missing, unknown, of another family or out of its range, and for a
///           grid of 2^63 settings or more
/// REQUIRES: grid.axes and grid.fixed are empty.
void read_parameters(const Value& parameters, Grid& grid);

}  // namespace portrait
