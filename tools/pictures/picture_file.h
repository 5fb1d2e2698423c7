/// A picture's file: SVG, PDF or PNG, with the command that made it inside, in the place its format has for that.
///
///     SVG   <title>, <desc> and <metadata>, which readers of the screen and browsers show
///     PDF   Title, Subject and Creator of the document's information, by an incremental update
///     PNG   tEXt chunks Title, Description and Software                                      (PNG 1.2, section 4.2.3)
#pragma once

#include <string>
#include <string_view>

namespace portrait::pictures {

enum class Format { svg, pdf, png };

/// By the extension. Throws InputError for any other.
Format format_of(const std::string& path);

struct About {
  std::string title;    ///< what is to be seen
  std::string command;  ///< the line that draws it again
  std::string program;  ///< "portrait 0.1.0 (...)"
};

/// The same picture with `about` in it. REQUIRES: `picture` is of this format.
std::string with_metadata(std::string picture, Format format, const About& about);

/// Writes under a temporary name and renames. Throws StoreError, InputError when the folder does not exist.
void write_file(const std::string& path, std::string_view content);

}  // namespace portrait::pictures
