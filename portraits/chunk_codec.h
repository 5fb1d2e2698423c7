/// A chunk as it lies in the file: what HDF5's filters shuffle, deflate and fletcher32 would make of its values,
/// made and undone without HDF5, so that any thread can do it.
///
/// A chunk is deflated when enough of its values repeat, else stored plain, with shuffle and deflate left out and
/// noted so in its filter mask; fletcher32 is never left out. Which of the two depends on the values alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace portrait {

/// HDF5's filter mask: a bit set for a filter left out, the first filter lowest.
enum class ChunkForm : std::uint32_t {
  deflated = 0b000,
  plain = 0b011,
};

/// What HDF5 appends to a chunk for fletcher32.
inline constexpr std::size_t kChecksumBytes = 4;

/// Whether deflating is worth its while: at least half of the values equal the two before them. docs/decisions.md
/// says what else was tried.
bool repeats(std::span<const std::byte> values, std::size_t element);

/// A whole chunk shuffled, deflated and checksummed. A plain one is its values, checksummed.
std::vector<std::byte> deflated_chunk(std::span<const std::byte> values, std::size_t element);
void append_checksum(std::vector<std::byte>& chunk);
std::array<std::byte, kChecksumBytes> checksum_of(std::span<const std::byte> chunk);

/// Undoes what was done to a chunk. REQUIRES: `values` has room for the chunk, exactly.
/// Gives back what is wrong, empty when nothing is: damage never becomes other values than a digest will tell.
std::string_view decode_chunk(std::span<const std::byte> stored, ChunkForm form, std::size_t element,
                              std::span<std::byte> values);

}  // namespace portrait
