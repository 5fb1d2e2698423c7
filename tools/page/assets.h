/// The files of the page, built from web/ and kept in the program.
#pragma once

#include <string_view>
#include <vector>

namespace portrait::page {

struct Asset {
  std::string_view path;  ///< "/", "/page.js"
  std::string_view type;  ///< "text/html; charset=utf-8"
  std::string_view content;
};

/// Empty when the page could not be built.
const std::vector<Asset>& assets();
/// Why it could not: "npm was not found ..."; empty when it could.
std::string_view why_no_assets();

}  // namespace portrait::page
