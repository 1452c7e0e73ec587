#include "server/http/socket_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <poll.h>
#include <sys/socket.h>

namespace gnomon {
namespace {

int millisecondsUntil(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

bool mayComeLater(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

} // namespace

SocketWait SocketReader::receive(std::size_t most, Clock::time_point deadline, const StopSignal* cut) {
  while (true) {
    std::array<pollfd, 2> waiting{{{fd_, POLLIN, 0}, {cut ? cut->fd() : -1, POLLIN, 0}}};
    const int ready = ::poll(waiting.data(), waiting.size(), millisecondsUntil(deadline));
    if (ready < 0 && errno != EINTR) return SocketWait::closed;
    if (ready > 0 && waiting[1].revents != 0) return SocketWait::cutOff;
    if (ready == 0 && Clock::now() >= deadline) return SocketWait::timedOut;
    if (ready > 0) {
      const std::size_t held = buffer_.size();
      buffer_.resize(held + std::min<std::size_t>(most, 64 * 1024));
      const ssize_t count = ::recv(fd_, buffer_.data() + held, buffer_.size() - held, MSG_DONTWAIT);
      const int error = errno;
      buffer_.resize(held + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      if (count > 0) return SocketWait::ready;
      if (count == 0 || !mayComeLater(error)) return SocketWait::closed;
    }
  }
}

void SocketReader::consume(std::size_t count) {
  begin_ += count;
  if (begin_ == buffer_.size()) {
    buffer_.clear();
    begin_ = 0;
  } else if (begin_ >= 64 * 1024) {
    buffer_.erase(0, begin_);
    begin_ = 0;
  }
}

std::string SocketReader::take() {
  std::string rest(buffered()); // without the room that a body may have taken
  buffer_ = {};
  begin_ = 0;
  return rest;
}

bool sendAll(int fd, std::string_view bytes, const Pace& pace, const StopSignal* cut, bool more) {
  const int flags = MSG_NOSIGNAL | MSG_DONTWAIT | (more ? MSG_MORE : 0);
  PaceMeter meter(pace, Clock::now());
  while (!bytes.empty()) {
    const ssize_t count = ::send(fd, bytes.data(), bytes.size(), flags);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      meter.moved(static_cast<std::size_t>(count), Clock::now());
      continue;
    }
    if (count < 0 && !mayComeLater(errno)) return false;
    const auto deadline = meter.deadline(Clock::now());
    std::array<pollfd, 2> waiting{{{fd, POLLOUT, 0}, {cut ? cut->fd() : -1, POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), millisecondsUntil(deadline)) == 0 || waiting[1].revents != 0) {
      return false;
    }
  }
  return true;
}

bool sendNow(int fd, std::string_view bytes) {
  return ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(bytes.size());
}

} // namespace gnomon
