/// TOML 1.0 text as a document. The one door to the TOML library: no other file includes it.
#pragma once

#include <string>
#include <string_view>

#include "grids/document.h"

namespace portrait {

/// Most parts of a dotted key, and most levels of tables and lists. No grid file needs a quarter; without a limit a
/// key of a hundred thousand parts exhausts the stack.
inline constexpr int kMaxDepth = 16;

/// The root table, its place 1:1.
/// throws    InputError in the library's own words for a text that is not TOML, and for one beyond the limit
Value parse_toml(std::string_view text, const std::string& source_name);

}  // namespace portrait
