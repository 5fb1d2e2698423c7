#include "tools/pictures/key.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace portrait::pictures {
namespace {

// Of the pictures' font, about: of a key that is wider than the picture gnuplot leaves out what does not fit. A row of the key is a little higher than one of text.
constexpr double kCharacter_cm = 0.212, kRow_cm = 0.43, kRow = 1.25, kSampleWidth = 8, kMostColumns = 3;
constexpr double kBelowAxis = 3.8;  // characters for tics and the name of the axis

}  // namespace

Key key_below(const std::vector<std::string>& titles, double width_cm) {
  std::size_t longest = 1;
  for (const std::string& title : titles) longest = std::max(longest, title.size());
  const double room = width_cm / kCharacter_cm / (static_cast<double>(longest) + kSampleWidth);
  const double columns = std::clamp(std::floor(room), 1.0, kMostColumns);
  const double rows = std::max(1.0, std::ceil(static_cast<double>(titles.size()) / columns));
  return {fmt::format(
              "set key at screen 0.5, character {:.4g} center top vertical maxrows {:.0f} Left reverse samplen 2\n"
              "set bmargin {:.4g}",
              kRow * rows + 0.3, rows, kRow * rows + kBelowAxis),
          kRow_cm * kRow * rows};
}

}  // namespace portrait::pictures
