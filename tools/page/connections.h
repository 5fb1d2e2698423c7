/// A web server for one person on this machine: 127.0.0.1 alone, and hard to starve.
///
/// cpp-httplib parses and routes; this file decides who may talk and for how long.
///
///     who       requests whose Host is this server's address, and whose Origin, when there is one, is its own: a page
///               from elsewhere cannot reach it through the user's browser, nor by a name that was pointed here
///     how long  a request must arrive whole within kReadLimit, an answer be taken within kWriteLimit, counted over the
///               whole of it, so that sending a byte now and then gains nothing
///     how much  kMaxHeader bytes before the body, kMaxBody of body, of known length, not compressed
///     how many  kMaxConnections at a time, a thread each; when all are in use, the one that has been waiting longest
///               for its client is closed in favour of the new one
///
/// tests     tests/tools/hostile_test.py
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <httplib.h>

namespace portrait::page {

inline constexpr std::chrono::seconds kReadLimit{5}, kIdleLimit{20}, kWriteLimit{20};
inline constexpr std::size_t kMaxHeader = 32'768, kMaxBody = 65'536, kMaxConnections = 64, kMaxWaiting = 256;

/// Which connections are open, and which of them wait for their client.
class OpenConnections {
 public:
  void opened(int socket);
  /// Whether it waits for its client, from now on.
  void waiting(int socket, bool is_waiting);
  /// Closes the socket; from here on its number may be used again.
  void close(int socket);
  /// Ends the connection that has waited longest for its client; false when none does.
  bool end_longest_waiting();
  /// Ends all, and those that are opened later.
  void end_all();

 private:
  using Clock = std::chrono::steady_clock;
  struct State {
    bool waiting;
    Clock::time_point since;
  };
  std::mutex mutex_;
  std::map<int, State> open_;
  bool ended_ = false;
};

/// Threads for connections, made as needed and kept. A thread that httplib hands a connection to runs it to its end.
class ConnectionThreads final : public httplib::TaskQueue {
 public:
  explicit ConnectionThreads(OpenConnections& open) : open_(open) {}
  void enqueue(std::function<void()> connection) override;
  void shutdown() override;

 private:
  void work();
  OpenConnections& open_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;
  bool ending_ = false;
};

class LoopbackServer final : public httplib::Server {
 public:
  LoopbackServer();

  /// The port, or any free one for 0. Throws InputError when it is taken.
  int bind(int port);
  /// Until `stop`. REQUIRES: bind.
  void serve();
  /// From any thread.
  void stop_serving();
  /// Runs one connection to its end, on this thread, and closes the socket; `serve` does so with those that come to its
  /// port. False when the last request broke off.
  bool talk(int socket);

  /// Answers POST requests with a JSON body; while it works on one, its connection is not ended to make room.
  void answer(const std::string& path, Handler handler);

 private:
  HandlerResponse admit(const httplib::Request& request, httplib::Response& response);
  bool process_and_close_socket(socket_t socket) override { return talk(socket); }

  OpenConnections open_;
  int port_ = 0;
};

}  // namespace portrait::page
