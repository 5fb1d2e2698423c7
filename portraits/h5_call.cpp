#include "portraits/h5_call.h"

#include "engine/base/error.h"
#include "portraits/h5_driver.h"

namespace portrait::h5 {
namespace {

herr_t keep_innermost(unsigned depth, const H5E_error2_t* error, void* words) {
  if (depth == 0) *static_cast<std::string*>(words) = error->desc;
  return 0;
}

std::string innermost(hid_t stack) {
  std::string words;
  H5Ewalk2(stack, H5E_WALK_UPWARD, keep_innermost, &words);
  return words;
}

}  // namespace

bool told_by_system(hid_t stack) { return innermost(stack).find("errno = ") != std::string::npos; }

// "... errno = 28, error message = 'No space left on device', ..." to the message.
std::string words_on(hid_t stack) {
  const std::string words = innermost(stack);
  const std::string before = "error message = '";
  const std::size_t found = words.find(before);
  if (found == std::string::npos) return words;
  const std::size_t first = found + before.size();
  return words.substr(first, words.find('\'', first) - first);
}

std::mutex& door() {
  static std::mutex mutex;
  return mutex;
}

Listener::Listener() { H5Eset_auto2(H5E_DEFAULT, hear, this); }

Listener::~Listener() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

herr_t Listener::hear(hid_t stack, void* self) {
  auto& listener = *static_cast<Listener*>(self);
  if (!listener.words_.empty()) return 0;
  listener.words_ = words_on(stack);
  listener.system_failed_ = told_by_system(stack);
  return 0;
}

void fail(const Origin& origin, const std::string& what, bool system_failed) {
  const std::string message = fmt::format("{}: {}", origin.file, what);
  if (origin.writing || system_failed) throw StoreError(message);
  throw IntegrityError(message);
}

void check_writes(const Origin& origin, const std::string& doing) {
  if (origin.fault && !origin.fault->words.empty())
    fail(origin, fmt::format("cannot {}: HDF5: {}", doing, origin.fault->words));
}

}  // namespace portrait::h5
