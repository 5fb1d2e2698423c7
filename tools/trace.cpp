#include "tools/trace.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace portrait::tools {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw StoreError(fmt::format("{}: {}", path, std::strerror(errno)));
}

using reference::value;

std::string rows(const reference::Piece& w, const reference::Piece& d) {
  const int points = std::max(1, static_cast<int>(std::ceil(w.length * kTracePointsPerDeadTime)));
  std::string text;
  for (int i = 0; i <= points; ++i) {
    const double x = 2.0 * i / points - 1;
    text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", w.start + 0.5 * (x + 1) * w.length, value(w.y, x),
                        value(w.u, x), value(d.y, x), value(d.u, x));
  }
  return text;
}

}  // namespace

void write_trace(const reference::Response& response, const std::string& path) {
  const std::string temporary = path + ".tmp";
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(temporary.c_str(), "w"), std::fclose);
  if (!file) fail(temporary);
  const auto& w = response.steps[reference::kSetpoint].pieces;
  const auto& d = response.steps[reference::kDisturbance].pieces;
  bool written = std::fputs("t,y_w,u_w,y_d,u_d\n", file.get()) >= 0;
  for (std::size_t i = 0; i < w.size() && written; ++i)
    written = std::fputs(rows(w[i], d[i]).c_str(), file.get()) >= 0;
  written = written && std::fflush(file.get()) == 0;
  if (!written || std::fclose(file.release()) != 0 || std::rename(temporary.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    std::remove(temporary.c_str());
    errno = reason;
    fail(path);
  }
}

}  // namespace portrait::tools
