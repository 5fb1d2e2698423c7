/// Fletcher's checksum of a stored chunk, as HDF5's filter fletcher32 takes it: of 16-bit words, high byte first,
/// with sums modulo 65535; an odd last byte is the high byte of a word.
///
/// cost      one pass, eight words at a time
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace portrait {

std::uint32_t fletcher32(std::span<const std::byte> bytes);

}  // namespace portrait
