/// An axis as a grid file writes it.
///
///     [6, 8, 10, inf]                                    the values, strictly increasing
///     { from = 0.05, to = 0.35, step = 0.01 }            equal steps, both ends belong to the axis
///     { from = 0.35, to = 1.05, count = 15 }             the same by number of values
///     { from = 0.01, to = 1, count = 9, scale = "log" }  equal ratios
///
/// throws    InputError with the place of the offending key or value
#pragma once

#include "grids/axis.h"
#include "grids/document.h"

namespace portrait {

Axis axis_in(Parameter parameter, const Value& value);

}  // namespace portrait
