#include "server/redis/dial.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <thread>

namespace gnomon::redis {
namespace {

using Endpoints = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

std::string errorText(int error) {
  return std::error_code(error, std::generic_category()).message();
}

Endpoints endpointsOf(const std::string& host, std::uint16_t port, int flags) {
  addrinfo hints{};
  hints.ai_flags = flags | AI_NUMERICSERV;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const bool known = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) == 0;
  return {known ? found : nullptr, [](addrinfo* list) { list != nullptr ? ::freeaddrinfo(list) : void(); }};
}

/// The result of a thread that resolves a name. The system's resolver knows no deadline of ours, so no caller may wait
/// for the thread: it may outlive the question.
struct Resolution {
  StopSignal done;
  Endpoints endpoints{nullptr, nullptr};
};

std::atomic<int> resolving = 0;

Endpoints resolve(const std::string& host, std::uint16_t port, Clock::time_point deadline, const StopSignal* cut) {
  constexpr int kMostThreads = 8; // a resolver that hangs holds so many, and no more
  if (Endpoints numeric = endpointsOf(host, port, AI_NUMERICHOST)) return numeric;
  if (++resolving > kMostThreads) {
    --resolving;
    return {nullptr, nullptr};
  }
  const auto resolution = std::make_shared<Resolution>();
  try {
    std::thread([resolution, host, port] {
      resolution->endpoints = endpointsOf(host, port, AI_ADDRCONFIG);
      --resolving;
      resolution->done.raise();
    }).detach();
  } catch (const std::system_error&) {
    --resolving;
    return {nullptr, nullptr};
  }
  if (!waitFor(resolution->done.fd(), POLLIN, deadline, cut)) return {nullptr, nullptr};
  return std::move(resolution->endpoints);
}

/// Empty, with errno, where no address answers.
FileDescriptor connectTo(const addrinfo& endpoint, Clock::time_point deadline, const StopSignal* cut) {
  FileDescriptor socket(
      ::socket(endpoint.ai_family, endpoint.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, endpoint.ai_protocol));
  if (!socket) return {};
  const int on = 1;
  ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  ::setsockopt(socket.get(), SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  if (::connect(socket.get(), endpoint.ai_addr, endpoint.ai_addrlen) == 0) return socket;
  if (errno != EINPROGRESS) return {};
  int error = ETIMEDOUT;
  socklen_t size = sizeof error;
  if (waitFor(socket.get(), POLLOUT, deadline, cut)) ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
  if (error == 0) return socket;
  errno = error;
  return {};
}

} // namespace

bool waitFor(int fd, short events, Clock::time_point deadline, const StopSignal* cut) {
  constexpr std::int64_t kLongest = 60'000; // milliseconds
  while (true) {
    std::array<pollfd, 2> waiting{{{fd, events, 0}, {cut != nullptr ? cut->fd() : -1, POLLIN, 0}}};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    const auto patience = static_cast<int>(std::clamp<std::int64_t>(left, 0, kLongest));
    const int ready = ::poll(waiting.data(), waiting.size(), patience);
    if (ready < 0 && errno != EINTR) return false;
    if (ready > 0) return waiting[1].revents == 0;
    if (Clock::now() >= deadline) return false;
  }
}

Dialled dial(const std::string& host, std::uint16_t port, Clock::time_point deadline, const StopSignal* cut) {
  const Endpoints endpoints = resolve(host, port, deadline, cut);
  if (!endpoints) return {{}, "Its name can't be resolved"};
  std::string reason;
  for (const addrinfo* endpoint = endpoints.get(); endpoint != nullptr; endpoint = endpoint->ai_next) {
    FileDescriptor socket = connectTo(*endpoint, deadline, cut);
    if (socket) return {std::move(socket)};
    reason = errorText(errno);
  }
  return {{}, reason};
}

} // namespace gnomon::redis
