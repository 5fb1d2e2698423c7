#include "portraits/page_memory.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include <sys/mman.h>

namespace portrait {
namespace {

/// What is large begins with a large page and has whole ones: the disk is then given it in few segments.
constexpr std::size_t kLargePage = std::size_t{2} << 20;
constexpr std::size_t kLarge = std::size_t{256} << 10;

/// Pieces given back, the last one first: it may still be in a cache of the processor.
class KeptPages {
 public:
  static KeptPages& all() {
    static KeptPages kept;
    return kept;
  }
  ~KeptPages() {
    for (const Kept& kept : free_) std::free(kept.memory);
  }

  /// Nothing where none fits well.
  PageMemory take(std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    const std::size_t most = std::max(2 * bytes, kLargePage);
    const auto fits = [=](const Kept& kept) { return bytes <= kept.bytes && kept.bytes <= most; };
    const auto found = std::find_if(free_.rbegin(), free_.rend(), fits);
    if (found == free_.rend()) return nullptr;
    PageMemory memory(found->memory, GiveBackPages{found->bytes});
    held_ -= found->bytes;
    free_.erase(std::next(found).base());
    return memory;
  }

  bool keep(std::byte* memory, std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    if (held_ + bytes > kKeptBytes) return false;
    free_.push_back({memory, bytes});
    held_ += bytes;
    return true;
  }

 private:
  struct Kept {
    std::byte* memory;
    std::size_t bytes;
  };
  std::mutex mutex_;
  std::vector<Kept> free_;
  std::size_t held_ = 0;
};

PageMemory new_pages(std::size_t bytes) {
  const std::size_t page = bytes >= kLarge ? kLargePage : kPageBytes;
  const std::size_t whole = (bytes + page - 1) / page * page;
  auto* memory = static_cast<std::byte*>(std::aligned_alloc(page, whole));
  if (memory == nullptr) throw std::bad_alloc();
  if (page == kLargePage) static_cast<void>(madvise(memory, whole, MADV_HUGEPAGE));  // only a hint
  return {memory, GiveBackPages{whole}};
}

}  // namespace

void GiveBackPages::operator()(std::byte* memory) const {
  if (!KeptPages::all().keep(memory, bytes)) std::free(memory);
}

PageMemory page_memory(std::size_t bytes) {
  bytes = std::max<std::size_t>(bytes, 1);
  PageMemory kept = KeptPages::all().take(bytes);
  return kept ? std::move(kept) : new_pages(bytes);
}

}  // namespace portrait
