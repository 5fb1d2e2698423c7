/// portrait serve: a page on 127.0.0.1 on which constraints move and region, optimum and responses follow.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "tools/exit_codes.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/page/assets.h"
#include "tools/page/connections.h"
#include "tools/page_answers.h"
#include "tools/page_routes.h"
#include "tools/verbs.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait serve huba.h5

Shows a portrait in the browser of this machine: any measure or expression over any two
axes, constraints that move, the optimum that follows, responses simulated at a click. The
address that it prints is that of a page on 127.0.0.1, which nobody else can reach. Ctrl-C
ends it.)";

constexpr int kUsualPort = 8137;
constexpr std::size_t kMegabyte = 1'000'000;

struct ServeArguments {
  std::string file;
  int port = -1;
  std::size_t memory = 1000;
};

int bound_port(page::LoopbackServer& server, int wanted) {
  if (wanted >= 0) return server.bind(wanted);
  try {
    return server.bind(kUsualPort);
  } catch (const InputError&) {
    return server.bind(0);
  }
}

int serve(const ServeArguments& a) {
  if (page::assets().empty())
    throw std::runtime_error(fmt::format("this program was built without its page: {}", page::why_no_assets()));
  const PageAnswers answers(a.file, a.memory * kMegabyte);
  if (answers.grid().axes.size() < 2)
    throw InputError(fmt::format("{}: a page needs a portrait with two axes or more", a.file));
  page::LoopbackServer server;
  add_routes(server, answers);
  add_assets(server);
  const int port = bound_port(server, a.port);
  const InterruptGuard interrupt;
  std::atomic<bool> ended = false;
  std::thread watch([&] {
    while (!interrupt.requested() && !ended) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    server.stop_serving();
  });
  print_text(fmt::format("http://127.0.0.1:{}/\n", port));
  std::fflush(stdout);
  print_message(fmt::format("showing {} at this address, on this machine alone; Ctrl-C ends it", a.file));
  server.serve();
  ended = true;
  watch.join();
  return kDone;
}

}  // namespace

void add_serve(CLI::App& app, Invocation& invocation) {
  auto a = std::make_shared<ServeArguments>();
  CLI::App* verb = add_verb(app, "serve", "a portrait as a page in the browser of this machine", kHelp);
  verb->add_option("file", a->file, "portrait file")->required();
  verb->add_option("--port", a->port, "port on 127.0.0.1; 0: any free one (default: 8137, or any free one)")
      ->check(CLI::Range(0, 65535));
  verb->add_option("--memory", a->memory, "megabytes of columns kept in memory")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  verb->callback([a, &invocation] { invocation.exit_code = serve(*a); });
}

}  // namespace portrait::tools
