/// Small datasets without chunks: axes, fixed parameters, tile digests. Read whole, and held against their
/// digest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "portraits/h5.h"

namespace portrait {

/// `axes` is 0 for a single number, 1 for a row, 2 for a table, which comes row by row. Throws IntegrityError when the dataset is missing, of
/// another type or shape, larger than the file, or not what was written.
std::vector<double> read_reals(const h5::File& file, const std::string& name, std::size_t axes);
std::vector<std::uint64_t> read_row_of_uint64(const h5::File& file, const std::string& name);

/// Writes all values and the digest. REQUIRES: the dataset has room for exactly these.
void write_plain(const h5::Dataset& dataset, const std::vector<double>& values);
void write_plain(const h5::Dataset& dataset, const std::vector<std::uint64_t>& values);

}  // namespace portrait
