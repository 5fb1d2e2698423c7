#include "tools/interrupt.h"

#include <csignal>

#include <unistd.h>

#include "tools/exit_codes.h"

namespace portrait::tools {
namespace {

std::atomic<bool> g_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int) {
  if (g_requested.exchange(true)) _exit(kInterrupted);
  const char text[] = "\nportrait: stopping; once more to leave at once\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
}

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};

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
  handle_with(on_signal);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of writing, with a message
}

InterruptGuard::~InterruptGuard() { handle_with(SIG_DFL); }

const std::atomic<bool>& InterruptGuard::requested() const { return g_requested; }

}  // namespace portrait::tools
