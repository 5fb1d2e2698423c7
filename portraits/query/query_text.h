/// A piece of text that a user typed, and how to point at a place in it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace portrait {

struct QueryText {
  std::string source;  ///< what the text is: "--minimize", "--where"
  std::string text;    ///< as typed
};

/// Longest text that is read: a limit that no honest question meets.
inline constexpr std::size_t kMaxQueryText = 4096;

/// Throws the InputError that shows the line with a caret below byte `offset`:
///
///     --minimize:1:9: unknown name "IAE_x" (did you mean "IAE_w"?)
///       IAE_d + IAE_x
///               ^
///
/// Lines and columns count from 1, columns in characters of UTF-8; what cannot be shown appears as "?".
[[noreturn]] void fail_at(const QueryText& text, std::size_t offset, const std::string& message);

/// The whole character of UTF-8 that starts at `offset`, or the single byte there when there is none.
/// REQUIRES: offset < text.size().
std::string_view character_at(std::string_view text, std::size_t offset);

/// A character as it may stand in a message: "\x01" for a control byte or one that is no UTF-8.
std::string shown(std::string_view character);

}  // namespace portrait
