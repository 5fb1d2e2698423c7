/// XXH3, 64 bits, of stored values: tells a damaged portrait from a whole one. It is no defence against
/// intent.
///
/// source    xxHash, XXH3_64bits with seed 0; `xxhsum -H3` prints the same digits for the same bytes
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

struct XXH3_state_s;

namespace portrait {

/// Of bytes that come in pieces; how they are cut does not matter.
class Digest {
 public:
  Digest();
  void add(std::span<const std::byte> bytes);
  std::uint64_t value() const;

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

std::uint64_t digest_of(std::span<const std::byte> bytes);
inline std::uint64_t digest_of(const std::string& text) { return digest_of(std::as_bytes(std::span(text))); }

/// 16 hexadecimal digits, small letters.
std::string digest_text(std::uint64_t digest);

}  // namespace portrait
