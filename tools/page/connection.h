/// One connection as httplib reads and writes it: buffered, with a limit of time and bytes over each whole request.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include "tools/page/connections.h"

namespace portrait::page {

class Connection final : public httplib::Stream {
 public:
  explicit Connection(int socket) : socket_(socket) {}

  /// Whether a request begins within kIdleLimit.
  bool wait_for_request();
  /// From here on the limits count anew.
  void begin_request();

  /// Whether a request broke off: what comes after it is no request.
  bool broke_off() const { return broke_off_; }

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool ready(short what, Clock::time_point until) const;
  bool fill();

  int socket_;
  std::array<char, 4096> buffer_{};
  std::size_t at_ = 0, end_ = 0;
  std::size_t taken_ = 0;  ///< bytes of this request
  Clock::time_point read_until_, write_until_;
  bool writing_ = false;
  bool broke_off_ = false;
};

}  // namespace portrait::page
