#include "tools/pictures/picture_file.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tools/pictures/gnuplot.h"
#include "tools/pictures/text.h"

namespace portrait::pictures {
namespace {

TEST(PictureFile, FormatIsThatOfTheName) {
  EXPECT_EQ(format_of("a.b/c.svg"), Format::svg);
  EXPECT_EQ(format_of("c.pdf"), Format::pdf);
  EXPECT_EQ(format_of("c.png"), Format::png);
  for (const char* name : {"c.jpg", "c", ".svg", "c.SVGZ"}) EXPECT_THROW(format_of(name), InputError) << name;
}

TEST(PictureFile, SvgHoldsTitleAndCommandEscaped) {
  const std::string svg = with_metadata("<svg width=\"1\">\n<title>Gnuplot</title>\n<g/></svg>", Format::svg,
                                        {"A < B", "x --where 'a <= 1 & b'", "p"});
  EXPECT_EQ(svg.find("Gnuplot"), std::string::npos);
  EXPECT_NE(svg.find("<title>A &lt; B</title>"), std::string::npos);
  EXPECT_NE(svg.find("<metadata>x --where &#39;a &lt;= 1 &amp; b&#39;</metadata>"), std::string::npos);
  EXPECT_LT(svg.find("<title>"), svg.find("<g/>"));
}

TEST(PictureFile, ControlCharactersDoNotReachXml) { EXPECT_EQ(xml_text("a\x01<\x1b[1m"), "a?&lt;?[1m"); }

TEST(Gnuplot, QuotedTextCannotEndItsQuotes) {
  EXPECT_EQ(quoted("it's\n'x"), "'it''s ''x'");
  Script script({8, 6});
  script.line("set title " + quoted("a'; system 'touch /tmp/portrait_was_here'; '"));
  script.line("plot x notitle");
  const std::string svg = drawn(script, Format::svg);
  EXPECT_NE(svg.find("touch"), std::string::npos);  // it is text in the picture, and no command
}

TEST(Gnuplot, AnErrorInTheScriptIsReported) {
  Script script({8, 6});
  script.line("plot nonsense(");
  EXPECT_THROW(drawn(script, Format::svg), std::runtime_error);
}

TEST(Gnuplot, PaletteGrowsDarker) {
  EXPECT_EQ(palette_colour(0), "#fde725");
  EXPECT_EQ(palette_colour(1), "#440154");
  double before = 1e9;
  for (int k = 0; k <= 20; ++k) {
    const unsigned long rgb = std::stoul(palette_colour(k / 20.0).substr(1), nullptr, 16);
    const double grey = 0.299 * static_cast<double>(rgb >> 16) + 0.587 * static_cast<double>(rgb >> 8 & 255) +
                        0.114 * static_cast<double>(rgb & 255);
    EXPECT_LT(grey, before) << k;
    before = grey;
  }
}

}  // namespace
}  // namespace portrait::pictures
