/// Progress of long work on stderr: a bar on a terminal, a line every few seconds otherwise, nothing when quiet.
///
///     [#########...............] 38 %  1,590 of 4,185 settings, 2,310/s, 1.1 s left
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace portrait::tools {

class Progress {
 public:
  enum class Style { bar, lines, quiet };

  /// The style for this stderr.
  static Style usual_style(bool quiet);

  Progress(std::uint64_t total, Style style);
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap to call often. One thread at a time.
  void update(std::uint64_t done);

  /// Wipes the bar, so that what follows starts on a clean line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  std::string text(std::uint64_t done, Clock::time_point now) const;

  const std::uint64_t total_;
  const Style style_;
  const Clock::time_point begin_;
  Clock::time_point next_;
  bool bar_shown_ = false;
};

/// "1,234,567"
std::string grouped(std::uint64_t number);

/// "12 ms", "4.2 s", "3 min 20 s", "2 h 05 min", "3 d 4 h"
std::string duration_text(double seconds);

}  // namespace portrait::tools
