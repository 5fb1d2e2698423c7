#include "portraits/query/query_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace portrait {
namespace {

unsigned char byte(char c) { return static_cast<unsigned char>(c); }

/// Bytes that a character with this first byte has; 1 for what is no first byte.
std::size_t announced_length(unsigned char first) {
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 1;
}

bool continues(char c) { return (byte(c) & 0xC0) == 0x80; }

/// One byte that a terminal cannot show as it is.
bool is_unprintable(std::string_view character) {
  return character.size() == 1 && (byte(character[0]) < 0x20 || byte(character[0]) >= 0x7F);
}

struct Line {
  std::size_t number;  ///< from 1
  std::size_t begin, end;
};

Line line_around(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t newline = before.rfind('\n');
  const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
  const auto newlines = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  return {newlines + 1, begin, std::min(text.find('\n', offset), text.size())};
}

std::string printable(std::string_view line) {
  std::string printed;
  for (std::size_t i = 0; i < line.size();) {
    const std::string_view c = character_at(line, i);
    printed += c == "\t" ? " " : is_unprintable(c) ? "?" : c;
    i += c.size();
  }
  return printed;
}

std::size_t character_count(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); i += character_at(text, i).size()) ++count;
  return count;
}

}  // namespace

std::string_view character_at(std::string_view text, std::size_t offset) {
  const std::size_t length = announced_length(byte(text[offset]));
  const std::string_view candidate = text.substr(offset, length);
  const bool whole = candidate.size() == length && std::all_of(candidate.begin() + 1, candidate.end(), continues);
  return whole ? candidate : candidate.substr(0, 1);
}

std::string shown(std::string_view character) {
  if (!is_unprintable(character)) return std::string(character);
  return fmt::format("\\x{:02x}", byte(character[0]));
}

void fail_at(const QueryText& text, std::size_t offset, const std::string& message) {
  const std::string_view all = text.text;
  const Line line = line_around(all, std::min(offset, all.size()));
  const std::size_t column = character_count(all.substr(line.begin, offset - line.begin));
  const std::string picture =
      fmt::format("\n  {}\n  {:>{}}", printable(all.substr(line.begin, line.end - line.begin)), '^', column + 1);
  throw InputError(Place{text.source, line.number, column + 1}, message + picture);
}

}  // namespace portrait
