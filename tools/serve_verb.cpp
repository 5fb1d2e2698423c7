/// portrait serve: a page on 127.0.0.1 on which constraints move and region, optimum and responses follow.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "tools/exit_codes.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/page/assets.h"
#include "tools/page/connections.h"
#include "tools/page_answers.h"
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

/// Nothing from elsewhere, nothing in a frame, no scripts but ours.
void set_headers(httplib::Response& response) {
  response.set_header(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
      "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_header("Referrer-Policy", "no-referrer");
  response.set_header("Cache-Control", "no-store");
}

void answer_error(httplib::Response& response, int status, const std::string& message) {
  response.status = status;
  response.set_content(Json{{"error", message}}.dump(-1, ' ', false, Json::error_handler_t::replace),
                       "application/json");
}

/// Runs an answer and says what went wrong with it.
template <typename Answer>
void guarded(httplib::Response& response, Answer answer) {
  set_headers(response);
  try {
    answer();
  } catch (const nlohmann::json::exception& error) {
    answer_error(response, 400, "request: not JSON as the page writes it");
  } catch (const InputError& error) {
    answer_error(response, 400, error.what());
  } catch (const BrokenPromise& error) {
    answer_error(response, 500, fmt::format("this is a bug in Portrait: {}", error.what()));
  } catch (const std::exception& error) {
    answer_error(response, 500, error.what());
  }
}

Json request_in(const httplib::Request& request) {
  // Depth first: a body of brackets alone would exhaust the stack of whoever walks it.
  int depth = 0;
  const auto shallow = [&](int level, Json::parse_event_t, Json&) {
    depth = std::max(depth, level);
    if (depth > 8) throw InputError("request: nested too deeply");
    return true;
  };
  Json json = Json::parse(request.body, shallow);
  if (!json.is_object()) throw InputError("request: not an object");
  return json;
}

void add_json(page::LoopbackServer& server, const char* path, std::function<Json(const Json&)> answer) {
  server.answer(path, [answer = std::move(answer)](const httplib::Request& request, httplib::Response& response) {
    guarded(response, [&] { response.set_content(answer(request_in(request)).dump(), "application/json"); });
  });
}

void add_answers(page::LoopbackServer& server, const PageAnswers& answers) {
  add_json(server, "/api/info", [&](const Json&) { return answers.info(); });
  add_json(server, "/api/setting", [&](const Json& request) { return answers.setting(request); });
  add_json(server, "/api/simulate", [&](const Json& request) { return answers.simulate(request); });
  add_json(server, "/api/front", [&](const Json& request) { return answers.front(request); });
  add_json(server, "/api/rules", [&](const Json& request) { return answers.rules(request); });
  add_json(server, "/api/quantiles", [&](const Json& request) { return answers.quantiles(request); });
  server.answer("/api/view", [&](const httplib::Request& request, httplib::Response& response) {
    guarded(response, [&] { response.set_content(answers.view(request_in(request)), "application/octet-stream"); });
  });
}

void add_assets(page::LoopbackServer& server) {
  for (const page::Asset& asset : page::assets())
    server.Get(std::string(asset.path), [&asset](const httplib::Request&, httplib::Response& response) {
      set_headers(response);
      response.set_content(asset.content.data(), asset.content.size(), std::string(asset.type));
    });
}

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
  add_answers(server, answers);
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
