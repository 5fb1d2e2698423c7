/// Deflates values that often repeat the one before: the bytes of the values, shuffled as HDF5's filter shuffle
/// does it, as a zlib stream [RFC 1950, RFC 1951] that every zlib inflates.
///
/// Only runs of equal values are sought, and the code is the fixed one: what does not repeat grows by up to an
/// eighth. In return it is many times faster than zlib, and the stream depends on the values alone, not on any
/// library's version.
///
/// shape     values of `element` bytes each, in a row
/// cost      bench/store_rate.cpp
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace portrait {

/// REQUIRES: element is 1, 4 or 8, and values.size() a multiple of it.
std::vector<std::byte> deflate_runs(std::span<const std::byte> values, std::size_t element);

}  // namespace portrait
