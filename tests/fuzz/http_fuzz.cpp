/// Any bytes on a connection to the page's server, through its parser, its routes and its answers: what comes back is
/// whole answers with a status that the server means to give, or nothing.
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <thread>

#include <sys/socket.h>
#include <unistd.h>

#include "engine/base/check.h"
#include "tests/portraits/sample.h"
#include "tools/page_routes.h"

namespace portrait {
namespace {

/// Routed as `portrait serve` does it. It listens nowhere: connections are handed to it. Its portrait is removed at once.
page::LoopbackServer& server() {
  static page::LoopbackServer* const made = [] {
    const auto path = std::filesystem::temp_directory_path() / ("portrait-http-" + std::to_string(getpid()) + ".h5");
    std::filesystem::remove(path);
    sample::write(path, sample::small_grid());
    static const tools::PageAnswers answers(path.string(), 1'000'000);
    std::filesystem::remove(path);
    auto* routed = new page::LoopbackServer;
    tools::add_routes(*routed, answers);
    tools::add_assets(*routed);
    return routed;
  }();
  return *made;
}

/// All that the server says to a client that sends this and no more.
std::string said_to(std::string_view bytes) {
  int ends[2];
  PORTRAIT_CHECK(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
  std::string said;
  std::thread client([&, end = ends[1]] {
    while (!bytes.empty()) {
      const ssize_t sent = send(end, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) break;  // it has ended the connection
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    shutdown(end, SHUT_WR);
    char part[65536];
    for (ssize_t got; (got = recv(end, part, sizeof part, 0)) > 0;) said.append(part, static_cast<std::size_t>(got));
    close(end);
  });
  server().talk(ends[0]);
  client.join();
  return said;
}

std::size_t number_after(std::string_view text, std::string_view word, std::size_t otherwise) {
  const std::size_t at = text.find(word);
  if (at == std::string_view::npos) return otherwise;
  std::size_t number = otherwise;
  std::from_chars(text.data() + at + word.size(), text.data() + text.size(), number);
  return number;
}

/// REQUIRES: no answer to HEAD, which announces a body and has none.
void check_answers(std::string_view said) {
  static const std::set<std::size_t> known = {100, 200, 400, 403, 404, 405, 411, 413, 414, 415, 416, 417};
  while (!said.empty()) {
    const std::size_t end = said.find("\r\n\r\n");
    PORTRAIT_CHECK(end != std::string_view::npos);
    const std::string_view head = said.substr(0, end);
    PORTRAIT_CHECK(known.count(number_after(head, "HTTP/1.1 ", 0)) == 1);
    said.remove_prefix(end + 4);
    const std::size_t length = number_after(head, "Content-Length: ", 0);
    PORTRAIT_CHECK(length <= said.size());
    said.remove_prefix(length);
  }
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view sent(reinterpret_cast<const char*>(bytes), size);
  const std::string said = portrait::said_to(sent);
  if (sent.find("HEAD") == std::string_view::npos) portrait::check_answers(said);
  return 0;
}
