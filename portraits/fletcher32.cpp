#include "portraits/fletcher32.h"

#include <algorithm>
#include <cstring>

#include "engine/base/clones.h"

namespace portrait {
namespace {

constexpr std::size_t kLanes = 32;
constexpr std::size_t kRowBytes = kLanes * sizeof(std::uint16_t);
/// Rows whose sums stay below 2^32: 65535 * 256 * 257 / 2 does.
constexpr std::size_t kRows = 256;

/// Modulo 65535, where only nothing at all is 0.
std::uint64_t folded(std::uint64_t sum) { return sum == 0 ? 0 : (sum - 1) % 65535 + 1; }

/// Of words, low byte first: their sum, and the sum of all partial sums.
struct Sums {
  std::uint64_t first = 0, second = 0;
};

void add_word(Sums& sums, unsigned word) {
  sums.first = folded(sums.first + word);
  sums.second = folded(sums.second + sums.first);
}

/// A lane is a column of the rows.
struct LaneSums {
  std::uint32_t first[kLanes] = {}, second[kLanes] = {};
};

/// Not inline, and word by word: gcc 12 makes vector code of this, and plain code of the likes of it.
PORTRAIT_CLONES LaneSums lane_sums(const std::byte* from, std::size_t rows) {
  LaneSums sums;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      std::uint16_t word;
      std::memcpy(&word, from + row * kRowBytes + lane * sizeof word, sizeof word);
      sums.first[lane] += word;
      sums.second[lane] += sums.first[lane];
    }
  return sums;
}

/// Word i of the n in these rows counts n - i times in the second sum.
void add_rows(Sums& sums, const std::byte* from, std::size_t rows) {
  const LaneSums lanes = lane_sums(from, rows);
  sums.second += kLanes * rows * sums.first;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    sums.first += lanes.first[lane];
    sums.second += kLanes * std::uint64_t{lanes.second[lane]} - lane * std::uint64_t{lanes.first[lane]};
  }
  sums = {folded(sums.first), folded(sums.second)};
}

/// Exchanging the bytes of every word multiplies the sums by 256, modulo 65535.
std::uint32_t high_byte_first(const Sums& sums) {
  return static_cast<std::uint32_t>(folded(sums.second * 256) << 16 | folded(sums.first * 256));
}

}  // namespace

std::uint32_t fletcher32(std::span<const std::byte> bytes) {
  Sums sums;
  while (bytes.size() >= kRowBytes) {
    const std::size_t rows = std::min(bytes.size() / kRowBytes, kRows);
    add_rows(sums, bytes.data(), rows);
    bytes = bytes.subspan(rows * kRowBytes);
  }
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    const unsigned high = at + 1 < bytes.size() ? std::to_integer<unsigned>(bytes[at + 1]) : 0;
    add_word(sums, std::to_integer<unsigned>(bytes[at]) | high << 8);
  }
  return high_byte_first(sums);
}

}  // namespace portrait
