#include "tools/pictures/picture_file.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <zlib.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/base/words.h"
#include "portraits/temporary_file.h"
#include "tools/pictures/text.h"

namespace portrait::pictures {
namespace {

// ---------------------------------------------------------------- SVG

/// The first element inside <svg>, where a title has to stand, in place of the drawing program's own.
std::string svg_with_metadata(std::string svg, const About& about) {
  for (const char* element : {"title", "desc"}) {
    const std::size_t begin = svg.find(fmt::format("<{}>", element)), end = svg.find(fmt::format("</{}>", element));
    if (begin != std::string::npos && end != std::string::npos)
      svg.erase(begin, end + std::strlen(element) + 3 - begin);
  }
  const std::size_t open = svg.find("<svg");
  PORTRAIT_CHECK(open != std::string::npos);
  const std::string head =
      fmt::format("\n<title>{}</title>\n<desc>Drawn by {}: {}</desc>\n<metadata>{}</metadata>\n",
                  xml_text(about.title), xml_text(about.program), xml_text(about.command), xml_text(about.command));
  return svg.insert(svg.find('>', open) + 1, head);
}

// ---------------------------------------------------------------- PNG

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

std::string png_text(const std::string& keyword, const std::string& text) {
  const std::string body = "tEXt" + keyword + '\0' + text;
  const auto crc = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(body.size() - 4)) + body +
         big_endian(static_cast<std::uint32_t>(crc));
}

/// Behind the signature (8 bytes) and the header chunk (25 bytes), before the pixels.
std::string png_with_metadata(std::string png, const About& about) {
  constexpr std::size_t kHead = 33;
  PORTRAIT_CHECK(png.size() > kHead && png.substr(12, 4) == "IHDR");
  return png.insert(kHead, png_text("Title", about.title) + png_text("Description", about.command) +
                               png_text("Software", about.program));
}

// ---------------------------------------------------------------- PDF

std::string pdf_string(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return "(" + escaped + ")";
}

/// What stands behind a key of the last trailer: "/Root 12 0 R" -> "12 0 R".
std::string trailer_entry(const std::string& pdf, const std::string& key) {
  const std::size_t trailer = pdf.rfind("trailer");
  PORTRAIT_CHECK(trailer != std::string::npos);
  std::size_t begin = pdf.find(key, trailer);
  PORTRAIT_CHECK(begin != std::string::npos);
  begin = pdf.find_first_not_of(' ', begin + key.size());
  return pdf.substr(begin, pdf.find_first_of("\n/>", begin) - begin);
}

/// An incremental update (PDF 1.7, 7.5.6): one new object, its entry in a further cross-reference table, and a trailer
/// that points to the table before.
std::string pdf_with_metadata(std::string pdf, const About& about) {
  const std::size_t start = pdf.rfind("startxref");
  PORTRAIT_CHECK(start != std::string::npos);
  const auto previous = std::stoull(pdf.substr(start + std::strlen("startxref")));
  const auto number = std::stoull(trailer_entry(pdf, "/Size"));
  const std::string root = trailer_entry(pdf, "/Root");
  const std::size_t object = pdf.size();
  pdf += fmt::format("{} 0 obj\n<< /Title {}\n   /Subject {}\n   /Creator {} >>\nendobj\n", number,
                     pdf_string(about.title), pdf_string(about.command), pdf_string(about.program));
  const std::size_t table = pdf.size();
  pdf += fmt::format("xref\n{} 1\n{:010} 00000 n \ntrailer\n<< /Size {} /Root {} /Info {} 0 R /Prev {} >>\n",
                     number, object, number + 1, root, number, previous);
  return pdf + fmt::format("startxref\n{}\n%%EOF\n", table);
}

}  // namespace

Format format_of(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".svg") return Format::svg;
  if (extension == ".pdf") return Format::pdf;
  if (extension == ".png") return Format::png;
  throw InputError(fmt::format("{}: a picture's name ends in .svg, .pdf or .png", path));
}

std::string with_metadata(std::string picture, Format format, const About& about) {
  switch (format) {
    case Format::svg:
      return svg_with_metadata(std::move(picture), about);
    case Format::pdf:
      return pdf_with_metadata(std::move(picture), about);
    case Format::png:
      return png_with_metadata(std::move(picture), about);
  }
  return picture;
}

void write_file(const std::string& path, std::string_view content) {
  check_target(path, Existing::replace);
  TemporaryFile temporary(path);
  std::ofstream file(temporary.path(), std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) throw StoreError(fmt::format("{}: {}", path, std::strerror(errno)));
  temporary.publish(Existing::replace);
}

}  // namespace portrait::pictures
