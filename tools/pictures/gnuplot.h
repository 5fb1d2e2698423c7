/// The door to gnuplot: a script goes in, the bytes of a picture come out. Nothing else in the house knows of it.
///
/// Lines are told apart by dash and symbol as well as by colour; the colours are those of Okabe and Ito, and the scale
/// of a map is viridis, light where values are small: both keep their order in grey and for colour-blind readers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tools/pictures/contours.h"
#include "tools/pictures/picture_file.h"

namespace portrait::pictures {

struct Size {
  double width_cm, height_cm;
};

/// A script in the making.
class Script {
 public:
  explicit Script(Size size) : size_(size) {}

  void line(std::string_view text) { (text_ += text) += '\n'; }
  /// Named data, one or more outlines with an empty line between them; gives the name, "$d3".
  std::string data(const std::vector<Outline>& outlines);
  /// Named rows of columns.
  std::string table(const std::vector<std::vector<double>>& rows);

  Size size() const { return size_; }
  const std::string& text() const { return text_; }

 private:
  std::string name();
  Size size_;
  std::string text_;
  std::size_t count_ = 0;
};

/// A text in quotes, all of it taken as it is.
std::string quoted(std::string_view text);
/// Line style of the k-th curve, "lw 2 lc rgb '#0072b2' dt 1"; repeats after eight.
std::string curve_style(std::size_t k);
/// "#0072b2"
std::string curve_colour(std::size_t k);
/// "set palette ..." with so many steps.
std::string palette(int steps);
/// A colour of the palette, 0 lightest .. 1 darkest, "#fde725".
std::string palette_colour(double share);

/// The picture. Throws std::runtime_error when gnuplot is not there or finds fault with the script.
std::string drawn(const Script& script, Format format);

/// Draws, puts `about` into the picture, and writes it.
void draw(const Script& script, const std::string& path, const About& about);

}  // namespace portrait::pictures
