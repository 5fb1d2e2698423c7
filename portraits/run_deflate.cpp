#include "portraits/run_deflate.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>

#include "engine/base/check.h"

namespace portrait {
namespace {

/// Bits as they go into the stream, the lowest first.
struct Code {
  std::uint32_t bits = 0;
  std::uint32_t length = 0;
};

constexpr std::size_t kShortestMatch = 3, kLongestMatch = 258;

/// Huffman codes go in from their highest bit.
constexpr Code reversed(std::uint32_t code, std::uint32_t length) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < length; ++i) bits |= (code >> i & 1) << (length - 1 - i);
  return {bits, length};
}

/// The fixed code of a literal or length [RFC 1951, 3.2.6].
constexpr Code symbol(std::uint32_t number) {
  if (number < 144) return reversed(0x30 + number, 8);
  if (number < 256) return reversed(0x190 + number - 144, 9);
  if (number < 280) return reversed(number - 256, 7);
  return reversed(0xc0 + number - 280, 8);
}

constexpr auto kLiterals = [] {
  std::array<Code, 256> codes;
  for (std::uint32_t byte = 0; byte < codes.size(); ++byte) codes[byte] = symbol(byte);
  return codes;
}();

/// "The last byte again, so many times": length, its extra bits, and distance 1, which is five zeros [3.2.5].
constexpr auto kMatches = [] {
  std::array<Code, kLongestMatch + 1> codes;
  std::uint32_t number = 257;
  std::uint32_t next = kShortestMatch;
  for (std::uint32_t extra = 0; extra <= 5; ++extra)
    for (int of_this_extra = extra == 0 ? 8 : 4; of_this_extra > 0; --of_this_extra, ++number)
      for (std::uint32_t k = 0; k < 1U << extra; ++k, ++next) {
        const Code length = symbol(number);
        codes[next] = {length.bits | k << length.length, length.length + extra + 5};
      }
  const Code longest = symbol(285);
  codes[kLongestMatch] = {longest.bits, longest.length + 5};
  return codes;
}();

class BitWriter {
 public:
  explicit BitWriter(std::byte* into) : into_(into) {}

  /// REQUIRES: at most 32 bits.
  void put(Code code) {
    held_ |= std::uint64_t{code.bits} << count_;
    count_ += code.length;
    if (count_ < 32) return;
    const auto low = static_cast<std::uint32_t>(held_);
    std::memcpy(into_, &low, sizeof low);
    into_ += sizeof low;
    held_ >>= 32;
    count_ -= 32;
  }

  /// Fills the last byte with zeros, and says where the stream ends.
  std::byte* finish() {
    for (; count_ > 0; count_ -= std::min<std::uint32_t>(count_, 8), held_ >>= 8)
      *into_++ = static_cast<std::byte>(held_ & 0xff);
    return into_;
  }

 private:
  std::byte* into_;
  std::uint64_t held_ = 0;
  std::uint32_t count_ = 0;
};

/// Adler-32 of the bytes before deflating [RFC 1950].
struct Adler {
  std::uint64_t first = 1, second = 0;

  void add(std::uint64_t byte) {
    first += byte;
    second += first;
  }
  void add_run(std::uint64_t byte, std::uint64_t count) {
    second += count * first + byte * (count * (count + 1) / 2);
    first += byte * count;
  }
  void fold() {
    first %= 65521;
    second %= 65521;
  }
  std::uint32_t value() const { return static_cast<std::uint32_t>(second << 16 | first); }
};

/// Values first .. first + count - 1 are equal.
struct Run {
  std::size_t first = 0, count = 0;
};

/// Runs long enough for a match; between them nothing counts as repeated.
template <typename Word>
std::vector<Run> runs_of(std::span<const std::byte> values) {
  const auto value = [&](std::size_t i) {
    Word word;
    std::memcpy(&word, values.data() + i * sizeof(Word), sizeof(Word));
    return word;
  };
  const std::size_t count = values.size() / sizeof(Word);
  std::vector<Run> runs;
  for (std::size_t first = 0, next = 1; first < count; first = next, ++next) {
    while (next < count && value(next) == value(first)) ++next;
    if (next - first > kShortestMatch) runs.push_back({first, next - first});
  }
  return runs;
}

std::vector<Run> runs_of(std::span<const std::byte> values, std::size_t element) {
  if (element == sizeof(std::uint64_t)) return runs_of<std::uint64_t>(values);
  if (element == sizeof(std::uint32_t)) return runs_of<std::uint32_t>(values);
  PORTRAIT_CHECK_EQ(element, sizeof(std::uint8_t));
  return runs_of<std::uint8_t>(values);
}

/// One byte of every value.
class Plane {
 public:
  Plane(const std::byte* first, std::size_t element, BitWriter& out, Adler& adler)
      : first_(first), element_(element), out_(out), adler_(adler) {}

  void literals(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const auto byte = std::to_integer<std::uint8_t>(first_[i * element_]);
      out_.put(kLiterals[byte]);
      adler_.add(byte);
    }
  }

  void run(const Run& run) {
    literals(run.first, run.first + 1);
    std::size_t left = run.count - 1;
    adler_.add_run(std::to_integer<std::uint8_t>(first_[run.first * element_]), left);
    while (left > 0) {
      std::size_t length = std::min(left, kLongestMatch);
      if (left > length && left - length < kShortestMatch) length = left - kShortestMatch;
      out_.put(kMatches[length]);
      left -= length;
    }
  }

 private:
  const std::byte* first_;
  std::size_t element_;
  BitWriter& out_;
  Adler& adler_;
};

}  // namespace

std::vector<std::byte> deflate_runs(std::span<const std::byte> values, std::size_t element) {
  const std::size_t count = values.size() / element;
  const std::vector<Run> runs = runs_of(values, element);
  const auto stream = std::make_unique_for_overwrite<std::byte[]>(values.size() / 8 * 9 + 64);  // 9 bits a byte, and more
  stream[0] = std::byte{0x78};                                // deflate, a window of 32 KiB
  stream[1] = std::byte{0x01};
  BitWriter out(&stream[2]);
  out.put({0b011, 3});  // the last block, of the fixed code
  Adler adler;
  for (std::size_t byte = 0; byte < element; ++byte) {
    Plane plane(values.data() + byte, element, out, adler);
    std::size_t next = 0;
    for (const Run& run : runs) {
      plane.literals(next, run.first);
      plane.run(run);
      next = run.first + run.count;
    }
    plane.literals(next, count);
    adler.fold();
  }
  out.put(symbol(256));
  std::byte* end = out.finish();
  for (int shift = 24; shift >= 0; shift -= 8) *end++ = static_cast<std::byte>(adler.value() >> shift & 0xff);
  return {stream.get(), end};
}

}  // namespace portrait
