#include "portraits/query/tokens.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace portrait {
namespace {

constexpr std::array<std::string_view, 5> kRelations = {"<=", ">=", "==", "<", ">"};
constexpr std::string_view kSigns = "+-*/^(),";

/// What people write for a relation that has another spelling here; longer ones first.
struct Misspelling {
  std::string_view written, meant;
};
constexpr std::array<Misspelling, 5> kMisspellings = {
    {{"=<", "<="}, {"=>", ">="}, {"\xE2\x89\xA4", "<="}, {"\xE2\x89\xA5", ">="}, {"=", "=="}}};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

class Cutter {
 public:
  explicit Cutter(const QueryText& text) : source_(text), text_(text.text) {}

  Token next() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    if (at_ == text_.size()) return {TokenKind::end, at_, {}};
    const char c = text_[at_];
    if (is_digit(c) || c == '.') return number();
    if (is_letter(c)) return taken(TokenKind::name, name_length());
    return symbol();
  }

 private:
  /// "K_-1" is one name: no other begins with K_ alone.
  std::size_t name_length() const {
    const std::size_t length = word_length(at_);
    const bool integral_gain = text_.substr(at_, length) == "K_" && text_.substr(at_ + length, 2) == "-1";
    return integral_gain ? length + 2 : length;
  }

  std::size_t word_length(std::size_t from) const {
    std::size_t end = from;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    return end - from;
  }

  Token taken(TokenKind kind, std::size_t length, double value = 0) {
    const Token token{kind, at_, text_.substr(at_, length), value};
    at_ += length;
    return token;
  }

  /// Everything that hangs together with the first digit, so that "1.2.3" and "2kappa" are shown whole.
  std::size_t number_length() const {
    std::size_t end = at_;
    while (end < text_.size()) {
      const char c = text_[end];
      const bool exponent_sign = (c == '+' || c == '-') && (text_[end - 1] == 'e' || text_[end - 1] == 'E') &&
                                 end + 1 < text_.size() && is_digit(text_[end + 1]);
      if (!is_digit(c) && !is_letter(c) && c != '.' && !exponent_sign) break;
      ++end;
    }
    return end - at_;
  }

  Token number() {
    const std::string_view word = text_.substr(at_, number_length());
    const char* const last = word.data() + word.size();
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), last, value);
    if (error == std::errc::result_out_of_range && end == last)
      fail_at(source_, at_, fmt::format("\"{}\" is outside the range of numbers", word));
    if (error != std::errc() || end != last) fail_at(source_, at_, fmt::format("\"{}\" is not a number", word));
    return taken(TokenKind::number, word.size(), value);
  }

  Token symbol() {
    const std::string_view rest = text_.substr(at_);
    for (const std::string_view relation : kRelations)
      if (rest.starts_with(relation)) return taken(TokenKind::symbol, relation.size());
    if (kSigns.find(rest[0]) != std::string_view::npos) return taken(TokenKind::symbol, 1);
    for (const auto& [written, meant] : kMisspellings)
      if (rest.starts_with(written))
        fail_at(source_, at_, fmt::format("\"{}\" is not a relation (did you mean \"{}\"?)", written, meant));
    fail_at(source_, at_, fmt::format("stray character \"{}\"", shown(character_at(text_, at_))));
  }

  const QueryText& source_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Token> tokens(const QueryText& text) {
  const Place start{text.source, 1, 1};
  if (text.text.size() > kMaxQueryText)
    throw InputError(
        start, fmt::format("the text is too long: {} characters, at most {}", text.text.size(), kMaxQueryText));
  Cutter cutter(text);
  std::vector<Token> cut = {cutter.next()};
  while (cut.back().kind != TokenKind::end) cut.push_back(cutter.next());
  if (cut.size() == 1) throw InputError(start, "the text is empty");
  return cut;
}

bool is_relation(const Token& token) {
  return token.kind == TokenKind::symbol &&
         std::find(kRelations.begin(), kRelations.end(), token.text) != kRelations.end();
}

}  // namespace portrait
