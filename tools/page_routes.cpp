#include "tools/page_routes.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "tools/page/assets.h"

namespace portrait::tools {
namespace {

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

}  // namespace

void add_routes(page::LoopbackServer& server, const PageAnswers& answers) {
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

}  // namespace portrait::tools
