/// The words of an expression or a constraint: numbers, names and symbols.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "portraits/query/query_text.h"

namespace portrait {

enum class TokenKind { number, name, symbol, end };

struct Token {
  TokenKind kind;
  std::size_t offset;     ///< of its first byte in the text
  std::string_view text;  ///< part of the text that was cut; empty at the end
  double number = 0;
};

/// The text cut into tokens, the last one of kind `end`. Spaces, tabs and line ends separate.
/// Symbols: + - * / ^ ( ) , < <= > >= ==
/// Throws InputError for a text that is empty or too long, a broken number, a stray character, a single "=".
/// REQUIRES: `text` outlives the tokens.
std::vector<Token> tokens(const QueryText& text);

bool is_relation(const Token& token);

}  // namespace portrait
