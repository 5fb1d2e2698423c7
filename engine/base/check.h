/// Our own mistakes. A check that fails is a bug in Portrait, never bad input: it throws, so that a sweep can
/// name the setting at which it happened, and it prints both values.
///
///     PORTRAIT_CHECK(condition)      always on
///     PORTRAIT_CHECK_EQ(a, b)        always on, prints a and b
///     PORTRAIT_ASSERT(condition)     only without NDEBUG: for inner loops
#pragma once

#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace portrait {

/// A broken promise inside Portrait.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] inline void check_failed(const char* file, int line, const char* text, const std::string& values) {
  throw BrokenPromise(fmt::format("{}:{}: check failed: {}{}", file, line, text, values));
}

template <typename A, typename B>
void check_equal(const A& a, const B& b, const char* file, int line, const char* text) {
  if (!(a == b)) check_failed(file, line, text, fmt::format(" ({} against {})", a, b));
}

}  // namespace portrait

#define PORTRAIT_CHECK(condition) \
  ((condition) ? void() : ::portrait::check_failed(__FILE__, __LINE__, #condition, {}))
#define PORTRAIT_CHECK_EQ(a, b) ::portrait::check_equal((a), (b), __FILE__, __LINE__, #a " == " #b)

#ifdef NDEBUG
#define PORTRAIT_ASSERT(condition) void()
#else
#define PORTRAIT_ASSERT(condition) PORTRAIT_CHECK(condition)
#endif
