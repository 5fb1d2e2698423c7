/// Memory that direct reads and writes (O_DIRECT) take as it is: it begins with a page and has whole pages.
///
/// What is given back is kept for whoever asks next, up to kKeptBytes: tiles come and go, a megabyte each, and the
/// allocator would cut up the holes that they leave, or give them back to the system, which has to clear new pages for
/// the next.
///
/// threads   any number
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace portrait {

inline constexpr std::size_t kPageBytes = 4096;
inline constexpr std::size_t kKeptBytes = std::size_t{64} << 20;

constexpr std::uint64_t whole_pages(std::uint64_t bytes) { return (bytes + kPageBytes - 1) / kPageBytes * kPageBytes; }

struct GiveBackPages {
  std::size_t bytes = 0;
  void operator()(std::byte* memory) const;
};
using PageMemory = std::unique_ptr<std::byte[], GiveBackPages>;

/// Room for so many bytes, and for the rest of their last page. What stands in it is anything.
PageMemory page_memory(std::size_t bytes);

}  // namespace portrait
