#include "tools/page/connections.h"

#include <charconv>

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "tools/page/connection.h"

namespace portrait::page {
namespace {

/// Set when a request was refused before its body was read: what follows on the connection is no request.
thread_local bool refused = false;
/// The connection that this thread runs.
thread_local int current_socket = -1;

std::size_t announced_length(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  return error == std::errc() && end == text.data() + text.size() ? length : kMaxBody + 1;
}

/// What is wrong with the head: 0, or the status to answer with.
int head_fault(const httplib::Request& request) {
  // The page asks for no parts, and thousands of them would be as many copies.
  if (request.has_header("Range")) return 416;
  if (request.has_header("Transfer-Encoding")) return 411;
  if (request.has_header("Content-Encoding")) return 415;
  if (request.has_header("Content-Length") && announced_length(request) > kMaxBody) return 413;
  const bool has_body = request.method == "POST";
  if (has_body && !request.has_header("Content-Length")) return 411;
  if (has_body && request.get_header_value("Content-Type") != "application/json") return 415;
  return 0;
}

/// Something came on it that nobody has read yet: this client is not one that says nothing.
bool has_spoken(int socket) {
  char byte = 0;
  return ::recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0;
}

void reuse_address(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

void OpenConnections::opened(int socket) {
  const std::lock_guard lock(mutex_);
  open_[socket] = {false, Clock::now()};
  if (ended_) ::shutdown(socket, SHUT_RDWR);
}

void OpenConnections::waiting(int socket, bool is_waiting) {
  const std::lock_guard lock(mutex_);
  open_[socket] = {is_waiting, Clock::now()};
}

void OpenConnections::close(int socket) {
  const std::lock_guard lock(mutex_);
  open_.erase(socket);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
}

bool OpenConnections::end_longest_waiting() {
  const std::lock_guard lock(mutex_);
  auto longest = open_.end();
  for (auto it = open_.begin(); it != open_.end(); ++it)
    if (it->second.waiting && (longest == open_.end() || it->second.since < longest->second.since) &&
        !has_spoken(it->first))
      longest = it;
  if (longest == open_.end()) return false;
  ::shutdown(longest->first, SHUT_RDWR);
  longest->second.waiting = false;
  return true;
}

void OpenConnections::end_all() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  for (const auto& [socket, state] : open_) ::shutdown(socket, SHUT_RDWR);
}

void ConnectionThreads::enqueue(std::function<void()> connection) {
  std::unique_lock lock(mutex_);
  waiting_.push_back(std::move(connection));
  if (idle_ < waiting_.size()) {
    if (threads_.size() < kMaxConnections)
      threads_.emplace_back([this] { work(); });
    else
      open_.end_longest_waiting();
  }
  changed_.notify_all();
  // Beyond this, new connections wait in the kernel.
  changed_.wait(lock, [&] { return waiting_.size() < kMaxWaiting || ending_; });
}

void ConnectionThreads::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    ++idle_;
    changed_.wait(lock, [&] { return !waiting_.empty() || ending_; });
    --idle_;
    if (waiting_.empty()) return;
    const std::function<void()> connection = std::move(waiting_.front());
    waiting_.pop_front();
    // Whoever waits behind this one shall not wait for clients that say nothing. Below the limit a thread comes for them.
    if (idle_ == 0 && !waiting_.empty() && threads_.size() == kMaxConnections) open_.end_longest_waiting();
    changed_.notify_all();
    lock.unlock();
    connection();
    lock.lock();
  }
}

void ConnectionThreads::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  open_.end_all();
  for (std::thread& thread : threads_) thread.join();
}

LoopbackServer::LoopbackServer() {
  new_task_queue = [this] { return new ConnectionThreads(open_); };
  set_socket_options(reuse_address);
  // Head and body are two packets: Nagle's algorithm would keep the second until the first is acknowledged, some 40 ms.
  set_tcp_nodelay(true);
  set_payload_max_length(kMaxBody);
  set_pre_routing_handler([this](const httplib::Request& q, httplib::Response& a) { return admit(q, a); });
}

int LoopbackServer::bind(int port) {
  port_ = port == 0 ? bind_to_any_port("127.0.0.1") : bind_to_port("127.0.0.1", port) ? port : -1;
  if (port_ <= 0) throw InputError(fmt::format("port {} of 127.0.0.1 is taken: give another --port", port));
  return port_;
}

void LoopbackServer::serve() { listen_after_bind(); }

void LoopbackServer::stop_serving() {
  stop();
  open_.end_all();
}

void LoopbackServer::answer(const std::string& path, Handler handler) {
  Post(path, [this, handler = std::move(handler)](const httplib::Request& request, httplib::Response& response) {
    open_.waiting(current_socket, false);
    handler(request, response);
  });
}

httplib::Server::HandlerResponse LoopbackServer::admit(const httplib::Request& request,
                                                       httplib::Response& response) {
  const std::string host = request.get_header_value("Host");
  const std::string own = fmt::format("127.0.0.1:{}", port_), name = fmt::format("localhost:{}", port_);
  const std::string origin = request.get_header_value("Origin");
  const bool known = host == own || host == name;
  const bool from_here = !request.has_header("Origin") || (known && origin == "http://" + host);
  int status = !known || !from_here || request.get_header_value_count("Host") != 1 ? 403 : head_fault(request);
  if (status == 0 && request.method != "GET" && request.method != "HEAD" && request.method != "POST") status = 405;
  if (status == 0) return HandlerResponse::Unhandled;
  refused = true;
  response.status = status;
  response.set_header("Connection", "close");
  response.set_content(status == 403 ? "This page is for this machine alone.\n" : "Not a request of this page.\n",
                       "text/plain");
  return HandlerResponse::Handled;
}

bool LoopbackServer::talk(int socket) {
  open_.opened(socket);
  current_socket = socket;
  Connection connection(socket);
  bool whole = true, closed = false;
  while (whole && !closed) {
    open_.waiting(socket, true);
    if (!connection.wait_for_request()) break;
    connection.begin_request();
    refused = false;
    whole = process_request(connection, false, closed, nullptr);
    if (refused || connection.broke_off()) break;
  }
  open_.close(socket);
  return whole;
}

}  // namespace portrait::page
