#include "tools/page/connection.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>

namespace portrait::page {

bool Connection::ready(short what, Clock::time_point until) const {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return false;
    pollfd wanted{socket_, what, 0};
    const int found = poll(&wanted, 1, static_cast<int>(left));
    if (found > 0) return true;
    if (found == 0 || errno != EINTR) return false;
  }
}

bool Connection::wait_for_request() { return at_ < end_ || ready(POLLIN, Clock::now() + kIdleLimit); }

void Connection::begin_request() {
  taken_ = 0;
  writing_ = false;
  read_until_ = Clock::now() + kReadLimit;
}

bool Connection::is_readable() const { return at_ < end_ || ready(POLLIN, read_until_); }

bool Connection::is_writable() const {
  return ready(POLLOUT, writing_ ? write_until_ : Clock::now() + kWriteLimit);
}

bool Connection::fill() {
  if (!ready(POLLIN, read_until_)) return false;
  const ssize_t got = recv(socket_, buffer_.data(), buffer_.size(), 0);
  at_ = 0;
  end_ = got > 0 ? static_cast<std::size_t>(got) : 0;
  return got > 0;
}

ssize_t Connection::read(char* bytes, std::size_t size) {
  const bool more = at_ < end_ || fill();
  const std::size_t count = std::min(size, end_ - at_);
  taken_ += count;
  broke_off_ = !more || taken_ > kMaxHeader + kMaxBody;
  if (broke_off_) return -1;
  std::memcpy(bytes, buffer_.data() + at_, count);
  at_ += count;
  return static_cast<ssize_t>(count);
}

/// The limit counts from the first byte of the answer.
ssize_t Connection::write(const char* bytes, std::size_t size) {
  if (!writing_) write_until_ = Clock::now() + kWriteLimit;
  writing_ = true;
  std::size_t done = 0;
  while (done < size) {
    if (!ready(POLLOUT, write_until_)) return -1;
    const ssize_t sent = send(socket_, bytes + done, size - done, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) return -1;
    if (sent > 0) done += static_cast<std::size_t>(sent);
  }
  return static_cast<ssize_t>(done);
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}

}  // namespace portrait::page
