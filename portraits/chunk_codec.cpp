#include "portraits/chunk_codec.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <zlib.h>

#include "engine/base/clones.h"
#include "portraits/fletcher32.h"
#include "portraits/run_deflate.h"

namespace portrait {
namespace {

template <typename Word>
[[gnu::always_inline]] inline std::size_t repeated(const std::byte* values, std::size_t count) {
  const auto value = [values](std::size_t i) {
    Word word;
    std::memcpy(&word, values + i * sizeof(Word), sizeof(Word));
    return word;
  };
  std::size_t repeats = 0;
  for (std::size_t i = 2; i < count; ++i) repeats += value(i) == value(i - 1) && value(i) == value(i - 2) ? 1 : 0;
  return repeats;
}

PORTRAIT_CLONES std::size_t repeated_doubles(const std::byte* values, std::size_t count) {
  return repeated<std::uint64_t>(values, count);
}

PORTRAIT_CLONES std::size_t repeated_floats(const std::byte* values, std::size_t count) {
  return repeated<std::uint32_t>(values, count);
}

/// From bytes of one place together to values together.
void unshuffle(std::span<const std::byte> shuffled, std::size_t element, std::span<std::byte> values) {
  const std::size_t count = values.size() / element;
  for (std::size_t byte = 0; byte < element; ++byte)
    for (std::size_t i = 0; i < count; ++i) values[i * element + byte] = shuffled[byte * count + i];
}

/// Whether the stream is whole and has just as many bytes.
bool inflate_into(std::span<const std::byte> stream, std::span<std::byte> bytes) {
  uLongf room = bytes.size();
  uLong used = stream.size();
  const int result = uncompress2(reinterpret_cast<Bytef*>(bytes.data()), &room,
                                 reinterpret_cast<const Bytef*>(stream.data()), &used);
  return result == Z_OK && room == bytes.size() && used == stream.size();
}

std::uint32_t little_endian(std::span<const std::byte> four) {
  std::uint32_t value = 0;
  std::memcpy(&value, four.data(), kChecksumBytes);
  return value;
}

}  // namespace

bool repeats(std::span<const std::byte> values, std::size_t element) {
  const std::size_t count = values.size() / element;
  const std::size_t repeating = element == 8   ? repeated_doubles(values.data(), count)
                                : element == 4 ? repeated_floats(values.data(), count)
                                               : repeated<std::uint8_t>(values.data(), count);
  return 2 * repeating >= count;
}

std::vector<std::byte> deflated_chunk(std::span<const std::byte> values, std::size_t element) {
  std::vector<std::byte> chunk = deflate_runs(values, element);
  append_checksum(chunk);
  return chunk;
}

void append_checksum(std::vector<std::byte>& chunk) {
  const std::array checksum = checksum_of(chunk);
  chunk.insert(chunk.end(), checksum.begin(), checksum.end());
}

std::array<std::byte, kChecksumBytes> checksum_of(std::span<const std::byte> chunk) {
  return std::bit_cast<std::array<std::byte, kChecksumBytes>>(fletcher32(chunk));
}

std::string_view decode_chunk(std::span<const std::byte> stored, ChunkForm form, std::size_t element,
                              std::span<std::byte> values) {
  if (stored.size() <= kChecksumBytes) return "is too short";
  const auto content = stored.first(stored.size() - kChecksumBytes);
  if (fletcher32(content) != little_endian(stored.last(kChecksumBytes))) return "has another checksum";
  if (form == ChunkForm::plain) {
    if (content.size() != values.size()) return "has another length";
    std::copy(content.begin(), content.end(), values.begin());
    return {};
  }
  std::vector<std::byte> shuffled(values.size());
  if (!inflate_into(content, shuffled)) return "does not inflate to its length";
  unshuffle(shuffled, element, values);
  return {};
}

}  // namespace portrait
