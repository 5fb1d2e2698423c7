/// Calling HDF5: what it says when it fails, and how that becomes one of our errors.
#pragma once

#include <mutex>
#include <string>
#include <type_traits>

#include <H5Cpp.h>
#include <fmt/format.h>

#include "portraits/h5.h"

namespace portrait::h5 {

/// A failed call of the C interface; the Listener heard what went wrong.
struct CallFailed {};

template <typename Result>
Result called(Result result) {
  if (result < 0) throw CallFailed{};
  return result;
}

/// The innermost message on an error stack; the system's own words when it was the system that failed.
std::string words_on(hid_t stack);
bool told_by_system(hid_t stack);

/// Hears HDF5's error stack at the call that failed, before closing other objects clears it. HDF5 prints nothing
/// while one listens, and nothing afterwards.
class Listener {
 public:
  Listener();
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  const std::string& words() const { return words_; }
  bool system_failed() const { return system_failed_; }

 private:
  static herr_t hear(hid_t stack, void* self);

  std::string words_;
  bool system_failed_ = false;
};

/// Throws StoreError for a file being written or when the system failed, else IntegrityError.
[[noreturn]] void fail(const Origin& origin, const std::string& what, bool system_failed = false);

/// Throws StoreError when a write of this file failed, now or before.
void check_writes(const Origin& origin, const std::string& doing);

/// Held by whoever is inside HDF5.
std::mutex& door();

/// Runs work that calls HDF5; its failure becomes "FILE: cannot DO: HDF5: the library's words".
/// One thread at a time: HDF5 need not have been built for more.
template <typename Work>
auto guarded(const Origin& origin, const std::string& doing, Work work) {
  const std::lock_guard one_at_a_time(door());
  Listener listener;
  const auto failed = [&](const std::string& words) {
    check_writes(origin, doing);
    fail(origin, fmt::format("cannot {}: HDF5: {}", doing, words), listener.system_failed());
  };
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
      work();
      check_writes(origin, doing);
    } else {
      auto result = work();
      check_writes(origin, doing);
      return result;
    }
  } catch (const H5::Exception& exception) {
    failed(listener.words().empty() ? exception.getDetailMsg() : listener.words());
    throw;
  } catch (const CallFailed&) {
    failed(listener.words());
    throw;
  }
}

}  // namespace portrait::h5
