#include "server/http/socket_io.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gnomon {
namespace {

int millisecondsUntil(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

} // namespace

SocketWait SocketReader::await(Clock::time_point deadline, bool endOnStop) {
  return buffered().empty() ? receive(16 * 1024, deadline, endOnStop) : SocketWait::ready;
}

SocketWait SocketReader::receive(std::size_t most, Clock::time_point deadline, bool endOnStop) {
  while (true) {
    std::array<pollfd, 2> waiting{{{fd_, POLLIN, 0}, {endOnStop ? stopFd_ : -1, POLLIN, 0}}};
    const int ready = ::poll(waiting.data(), waiting.size(), millisecondsUntil(deadline));
    if (ready < 0 && errno != EINTR) {
      return SocketWait::closed;
    }
    if (ready == 0 && Clock::now() >= deadline) {
      return SocketWait::timedOut;
    }
    if (waiting[0].revents != 0) {
      const std::size_t held = buffer_.size();
      buffer_.resize(held + std::min<std::size_t>(most, 64 * 1024));
      const ssize_t count = ::recv(fd_, buffer_.data() + held, buffer_.size() - held, MSG_DONTWAIT);
      buffer_.resize(held + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
      if (count > 0) {
        return SocketWait::ready;
      }
      if (count == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) {
        return SocketWait::closed;
      }
    } else if (waiting[1].revents != 0) {
      return SocketWait::stopped;
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

bool sendAll(int fd, std::string_view bytes, Clock::time_point deadline) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      continue;
    }
    if (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
      return false;
    }
    pollfd waiting{fd, POLLOUT, 0};
    if (::poll(&waiting, 1, millisecondsUntil(deadline)) == 0 && Clock::now() >= deadline) {
      return false;
    }
  }
  return true;
}

void lingerAndClose(FileDescriptor socket, Clock::time_point deadline) {
  ::shutdown(socket.get(), SHUT_WR);
  std::array<char, 16 * 1024> discarded;
  while (Clock::now() < deadline) {
    pollfd waiting{socket.get(), POLLIN, 0};
    if (::poll(&waiting, 1, millisecondsUntil(deadline)) <= 0) {
      continue;
    }
    if (::recv(socket.get(), discarded.data(), discarded.size(), MSG_DONTWAIT) <= 0) {
      break;
    }
  }
}

std::string peerAddress(int fd) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  std::array<char, NI_MAXHOST> text{};
  if (::getpeername(fd, reinterpret_cast<sockaddr*>(&address), &length) != 0 ||
      ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), length, text.data(), text.size(), nullptr, 0,
                    NI_NUMERICHOST) != 0) {
    return "";
  }
  return text.data();
}

bool peerGone(int fd) {
  char byte = 0;
  const ssize_t count = ::recv(fd, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

} // namespace gnomon
