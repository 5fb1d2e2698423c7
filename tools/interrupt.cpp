#include "tools/interrupt.h"

#include <csignal>
#include <cstring>

#include <unistd.h>

#include "tools/exit_codes.h"

namespace portrait::tools {
namespace {

std::atomic<bool> g_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);
// A signal handler may touch nothing that allocates: the name lives in plain memory.
char g_remove_path[4096] = "";

extern "C" void on_signal(int) {
  if (g_requested.exchange(true)) {
    if (g_remove_path[0] != '\0') unlink(g_remove_path);
    _exit(kInterrupted);
  }
  const char text[] = "\nportrait: stopping; once more to leave at once\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
}

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

void handle_with(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : kSignals) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  g_requested = false;
  g_remove_path[0] = '\0';
  handle_with(on_signal);
}

InterruptGuard::~InterruptGuard() {
  handle_with(SIG_DFL);
  g_remove_path[0] = '\0';
}

const std::atomic<bool>& InterruptGuard::requested() const { return g_requested; }

void InterruptGuard::remove_on_second(const std::string& path) {
  if (path.size() < sizeof g_remove_path) std::strcpy(g_remove_path, path.c_str());
}

}  // namespace portrait::tools
