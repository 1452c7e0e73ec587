#include "server/http/socket_io.h"

#include <array>
#include <cerrno>
#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

namespace gnomon {
namespace {

constexpr int kRoundTripMilliseconds = 10; ///< a reset that takes longer is found by the next call

} // namespace

bool mayComeLater(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

void resetWhenClosed(int fd) {
  const linger none{.l_onoff = 1, .l_linger = 0};
  ::setsockopt(fd, SOL_SOCKET, SO_LINGER, &none, sizeof none);
}

std::size_t unacknowledged(int fd) {
  int bytes = 0;
  return ::ioctl(fd, SIOCOUTQ, &bytes) == 0 ? static_cast<std::size_t>(bytes) : 0;
}

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

bool sendNow(int fd, std::string_view bytes) {
  return ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) == static_cast<ssize_t>(bytes.size());
}

bool ClientWatch::isReset(int milliseconds) const {
  pollfd waiting{fd_, 0, 0};
  return ::poll(&waiting, 1, milliseconds) > 0 && (waiting.revents & (POLLHUP | POLLERR)) != 0;
}

bool ClientWatch::left() {
  const std::lock_guard lock(mutex_);
  if (left_ || ended_) return left_;
  pollfd waiting{fd_, POLLRDHUP, 0};
  ::poll(&waiting, 1, 0);
  left_ = (waiting.revents & (POLLHUP | POLLERR)) != 0;
  if (!left_ && (waiting.revents & POLLRDHUP) != 0) {
    if (streaming_) {
      left_ = true;
    } else if (mayAsk_ && unacknowledged(fd_) == 0) { // behind earlier bytes it could be sent in part only
      mayAsk_ = false;
      left_ = !sendNow(fd_, "HTTP/1.1 100 Continue\r\n\r\n") || isReset(kRoundTripMilliseconds);
    }
  }
  return left_;
}

void ClientWatch::beginStream() {
  const std::lock_guard lock(mutex_);
  streaming_ = true;
}

void ClientWatch::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
}

} // namespace gnomon
