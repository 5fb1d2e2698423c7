#include "tools/trace.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace portrait::tools {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw StoreError(fmt::format("{}: {}", path, std::strerror(errno)));
}

using reference::value;

constexpr int kMostPoints = 200;  ///< of a panel; without dead time one may be long

constexpr const char* kNames[reference::kSteps] = {"w", "d", "o"};

/// The steps that were simulated; without dead time too their pieces have the same edges.
std::vector<std::size_t> steps_of(const reference::Response& response) {
  std::vector<std::size_t> steps;
  for (std::size_t step = 0; step < reference::kSteps; ++step)
    if (!response.steps[step].pieces.empty()) steps.push_back(step);
  return steps;
}

std::string head(const std::vector<std::size_t>& steps) {
  std::string text = "t";
  for (const std::size_t step : steps) text += fmt::format(",y_{0},u_{0}", kNames[step]);
  return text + "\n";
}

std::string rows(const reference::Response& response, const std::vector<std::size_t>& steps, std::size_t piece) {
  const reference::Piece& at = response.steps[steps[0]].pieces[piece];
  const int points = std::clamp(static_cast<int>(std::ceil(at.length * kTracePointsPerDeadTime)), 1, kMostPoints);
  std::string text;
  for (int i = 0; i <= points; ++i) {
    const double x = 2.0 * i / points - 1;
    text += fmt::format("{:.9g}", at.start + 0.5 * (x + 1) * at.length);
    for (const std::size_t step : steps) {
      const reference::Piece& of = response.steps[step].pieces[piece];
      text += fmt::format(",{:.9g},{:.9g}", value(of.y, x), value(of.u, x));
    }
    text += "\n";
  }
  return text;
}

}  // namespace

void write_trace(const reference::Response& response, const std::string& path) {
  const std::string temporary = path + ".tmp";
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(temporary.c_str(), "w"), std::fclose);
  if (!file) fail(temporary);
  const std::vector<std::size_t> steps = steps_of(response);
  bool written = std::fputs(head(steps).c_str(), file.get()) >= 0;
  for (std::size_t i = 0; i < response.steps[steps[0]].pieces.size() && written; ++i)
    written = std::fputs(rows(response, steps, i).c_str(), file.get()) >= 0;
  written = written && std::fflush(file.get()) == 0;
  if (!written || std::fclose(file.release()) != 0 || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    std::remove(temporary.c_str());
    errno = reason;
    fail(path);
  }
}

}  // namespace portrait::tools
