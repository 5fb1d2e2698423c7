#include "tools/pictures/gnuplot.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/check.h"

extern char** environ;

namespace portrait::pictures {
namespace {

constexpr std::array<const char*, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
/// viridis at equal steps, light to dark.
constexpr std::array<std::array<int, 3>, 9> kPalette = {{{253, 231, 37},
                                                         {173, 220, 48},
                                                         {94, 201, 98},
                                                         {40, 174, 128},
                                                         {33, 145, 140},
                                                         {44, 114, 142},
                                                         {59, 82, 139},
                                                         {71, 45, 123},
                                                         {68, 1, 84}}};

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File scratch() {
  File file(std::tmpfile(), std::fclose);
  if (!file) throw std::runtime_error(fmt::format("no temporary file: {}", std::strerror(errno)));
  return file;
}

std::string content(std::FILE* file) {
  std::string text;
  std::array<char, 1 << 16> buffer;
  std::rewind(file);
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), file)) > 0;) text.append(buffer.data(), n);
  return text;
}

/// Pixels are those of 96 to the inch on the screen, and twice as many in a PNG, which has to serve print too.
std::string terminal(Format format, Size size) {
  const double px = 96 / 2.54;
  switch (format) {
    case Format::svg:
      return fmt::format(
          "set terminal svg size {:.0f},{:.0f} font 'Helvetica,13' linewidth 1.2 dashlength 0.8 background 'white'",
          size.width_cm * px, size.height_cm * px);
    case Format::pdf:
      return fmt::format(
          "set terminal pdfcairo size {}cm,{}cm font 'Helvetica,10' linewidth 1.2 dashlength 0.7 pointscale 0.8",
          size.width_cm, size.height_cm);
    case Format::png:
      return fmt::format(
          "set terminal pngcairo size {:.0f},{:.0f} font 'Helvetica,20' linewidth 2.2 dashlength 0.6 pointscale "
          "2.2 background 'white'",
          2 * size.width_cm * px, 2 * size.height_cm * px);
  }
  return "";
}

struct Actions {
  Actions() { posix_spawn_file_actions_init(&actions); }
  ~Actions() { posix_spawn_file_actions_destroy(&actions); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  posix_spawn_file_actions_t actions;
};

/// Through files, not pipes: neither side can wait for the other.
int run(std::FILE* in, std::FILE* out, std::FILE* errors) {
  Actions set;
  posix_spawn_file_actions_adddup2(&set.actions, fileno(in), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&set.actions, fileno(out), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&set.actions, fileno(errors), STDERR_FILENO);
  std::string program = "gnuplot", option = "-";
  std::array<char*, 3> arguments = {program.data(), option.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, "gnuplot", &set.actions, nullptr, arguments.data(), environ);
  if (failure != 0)
    throw std::runtime_error(
        fmt::format("gnuplot, which draws the pictures, cannot be started ({}): install it "
                    "(Debian: apt-get install gnuplot-nox)",
                    std::strerror(failure)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

std::string Script::name() { return fmt::format("$d{}", count_++); }

std::string Script::data(const std::vector<Outline>& outlines) {
  const std::string block = name();
  line(block + " << EOD");
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    if (k > 0) line("");
    for (const Point& p : outlines[k]) line(fmt::format("{:.8g} {:.8g}", p.x, p.y));
  }
  line("EOD");
  return block;
}

std::string Script::table(const std::vector<std::vector<double>>& rows) {
  const std::string block = name();
  line(block + " << EOD");
  for (const auto& row : rows) {
    std::string text;
    for (const double value : row) text += std::isfinite(value) ? fmt::format("{:.8g} ", value) : "NaN ";
    line(text);
  }
  line("EOD");
  return block;
}

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += '\'';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + "'";
}

std::string curve_colour(std::size_t k) { return kColours[k % kColours.size()]; }

std::string curve_style(std::size_t k) {
  constexpr std::array<int, 5> kDashes = {1, 2, 4, 5, 3};
  return fmt::format("lw 1.8 lc rgb '{}' dt {}", curve_colour(k), kDashes[k % kDashes.size()]);
}

std::string palette_colour(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kPalette.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), kPalette.size() - 2);
  std::string colour = "#";
  for (std::size_t c = 0; c < 3; ++c)
    colour += fmt::format("{:02x}",
                          std::lround(std::lerp(kPalette[k][c], kPalette[k + 1][c], at - static_cast<double>(k))));
  return colour;
}

std::string palette(int steps) {
  std::string stops;
  for (int k = 0; k < steps; ++k) {
    const double share = steps > 1 ? static_cast<double>(k) / (steps - 1) : 0;
    stops += fmt::format("{}{} '{}', {} '{}'", k > 0 ? ", " : "", k, palette_colour(share), k + 1,
                         palette_colour(share));
  }
  return fmt::format("set palette defined ({})", stops);
}

std::string drawn(const Script& script, Format format) {
  const File in = scratch(), out = scratch(), errors = scratch();
  const std::string text = terminal(format, script.size()) +
                           "\nset termoption noenhanced\nset encoding utf8\nset tics nomirror front\nset border 3\n"
                           "set grid lc rgb '#dddddd' lw 0.5\nset key spacing 1.25\n" +
                           script.text();
  if (std::fwrite(text.data(), 1, text.size(), in.get()) != text.size() || std::fflush(in.get()) != 0)
    throw std::runtime_error(fmt::format("a temporary file cannot be written: {}", std::strerror(errno)));
  std::rewind(in.get());
  const int status = run(in.get(), out.get(), errors.get());
  std::string picture = content(out.get());
  if (status != 0 || picture.empty()) throw std::runtime_error("gnuplot failed: " + content(errors.get()));
  return picture;
}

void draw(const Script& script, const std::string& path, const About& about) {
  const Format format = format_of(path);
  write_file(path, with_metadata(drawn(script, format), format, about));
}

}  // namespace portrait::pictures
