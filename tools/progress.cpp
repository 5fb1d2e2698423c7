#include "tools/progress.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace portrait::tools {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kBarEvery{100};
constexpr milliseconds kLineEvery{5000};
constexpr std::uint64_t kBarWidth = 24;

milliseconds period(Progress::Style style) { return style == Progress::Style::bar ? kBarEvery : kLineEvery; }

void write(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

Progress::Style Progress::usual_style(bool quiet) {
  if (quiet) return Style::quiet;
  return isatty(STDERR_FILENO) == 1 ? Style::bar : Style::lines;
}

Progress::Progress(std::uint64_t total, Style style)
    : total_(total), style_(style), begin_(Clock::now()), next_(begin_ + period(style)) {}

void Progress::finish() {
  if (bar_shown_) write("\r\033[K");
  bar_shown_ = false;
}

void Progress::update(std::uint64_t done) {
  if (style_ == Style::quiet) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + period(style_);
  if (style_ == Style::lines) return write(text(done, now) + "\n");
  const std::uint64_t filled = total_ == 0 ? kBarWidth : kBarWidth * done / total_;
  write(fmt::format("\r[{:#<{}}{:.<{}}] {}\033[K", "", filled, "", kBarWidth - filled, text(done, now)));
  bar_shown_ = true;
}

std::string Progress::text(std::uint64_t done, Clock::time_point now) const {
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double rate = static_cast<double>(done) / seconds;
  const auto percent =
      total_ == 0 ? 100 : static_cast<int>(100.0 * static_cast<double>(done) / static_cast<double>(total_));
  std::string line = fmt::format("{} %  {} of {} settings", percent, grouped(done), grouped(total_));
  if (done == 0) return line;
  return line + fmt::format(", {}/s, {} left", grouped(static_cast<std::uint64_t>(rate)),
                            duration_text(static_cast<double>(total_ - done) / rate));
}

std::string grouped(std::uint64_t number) {
  const std::string digits = fmt::format("{}", number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string duration_text(double seconds) {
  if (seconds < 1) return fmt::format("{:.0f} ms", 1000 * seconds);
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  if (seconds < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  if (seconds < 86400) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  return fmt::format("{} d {} h", whole / 86400, whole / 3600 % 24);
}

}  // namespace portrait::tools
