#include "server/http/http_server.h"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <system_error>
#include <utility>

#include "server/system/log.h"

namespace gnomon {
namespace {

constexpr int kBacklog = 512;             ///< connections that the kernel holds until they are accepted
constexpr int kPauseMilliseconds = 50;    ///< before accepting again
constexpr int kGoneMilliseconds = 20'000; ///< a client that acknowledges nothing for so long is cut off

/// What the kernel takes of a reply beyond what is on its way: without it megabytes, which no budget would count.
constexpr int kUnsentBytes = 128 * 1024;

void set(int fd, int level, int option, int value) {
  ::setsockopt(fd, level, option, &value, sizeof value); // what a socket of another family does not know, it lacks
}

/// A client whose cable was pulled is noticed by the kernel, whether something is being sent or not.
void setUpConnection(int fd) {
  set(fd, IPPROTO_TCP, TCP_NODELAY, 1);
  set(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(fd, IPPROTO_TCP, TCP_KEEPIDLE, 10);
  set(fd, IPPROTO_TCP, TCP_KEEPINTVL, 5);
  set(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, kGoneMilliseconds);
  set(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, kUnsentBytes);
}

PeerAddress peerOf(const sockaddr_storage& address) {
  const bool isIpv6 = address.ss_family == AF_INET6;
  const void* bytes = isIpv6 ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr)
                             : &reinterpret_cast<const sockaddr_in&>(address).sin_addr;
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(address.ss_family, bytes, text.data(), text.size());
  return peerAddress(ipAddress(text.data()).value_or(IpAddress())); // IPv4 on a socket that takes both is IPv4
}

FileDescriptor listenOn(const addrinfo& address) {
  FileDescriptor socket(::socket(address.ai_family, address.ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket) return socket;
  set(socket.get(), SOL_SOCKET, SO_REUSEADDR, 1); // not REUSEPORT: two servers must not share a port
  if (address.ai_family == AF_INET6) set(socket.get(), IPPROTO_IPV6, IPV6_V6ONLY, 0);
  if (::bind(socket.get(), address.ai_addr, address.ai_addrlen) != 0 || ::listen(socket.get(), kBacklog) != 0) {
    socket.reset();
  }
  return socket;
}

} // namespace

AfterAccept afterAccept(int error) {
  switch (error) {
    case EMFILE:
    case ENFILE:
    case ENOBUFS:
    case ENOMEM:
      return AfterAccept::pause;
    case EBADF:
    case EFAULT:
    case EINVAL:
    case ENOTSOCK:
    case EOPNOTSUPP:
      return AfterAccept::giveUp;
    default: // ECONNABORTED, EINTR, EAGAIN, EPERM of a firewall, and errors of the network that accept() passes on
      return AfterAccept::next;
  }
}

std::optional<Listener> Listener::open(const std::string& bind, int port) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (::getaddrinfo(bind.c_str(), std::to_string(port).c_str(), &wanted, &found) != 0) return std::nullopt;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    if (FileDescriptor socket = listenOn(*each)) return Listener(std::move(socket));
  }
  return std::nullopt;
}

int Listener::port() const {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &length) != 0) return 0;
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                             : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

bool Listener::run(const StopSignal& stop, const std::function<void(OpenConnection)>& accepted,
                   const std::function<void()>& scarce) {
  bool isScarce = false;
  while (true) {
    std::array<pollfd, 2> waiting{{{stop.fd(), POLLIN, 0}, {isScarce ? -1 : socket_.get(), POLLIN, 0}}};
    ::poll(waiting.data(), waiting.size(), isScarce ? kPauseMilliseconds : -1);
    if (waiting[0].revents != 0) {
      socket_.reset(); // a client that connects now is refused, instead of waiting in vain
      return true;
    }
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    FileDescriptor socket(
        ::accept4(socket_.get(), reinterpret_cast<sockaddr*>(&address), &length, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket) {
      isScarce = false;
      setUpConnection(socket.get());
      accepted({std::move(socket), peerOf(address)});
      continue;
    }
    const int error = errno;
    const AfterAccept after = afterAccept(error);
    if (after == AfterAccept::giveUp) {
      logEvent("listener", std::generic_category().message(error));
      return false;
    }
    if (after == AfterAccept::pause) {
      if (!isScarce) logEvent("listener", "Connections must wait: " + std::generic_category().message(error) + ".");
      scarce();
    }
    isScarce = after == AfterAccept::pause;
  }
}

std::string addressOf(const std::string& bind, int port) {
  const bool ipv6 = bind.find(':') != std::string::npos;
  return "http://" + (ipv6 ? "[" + bind + "]" : bind) + ":" + std::to_string(port);
}

Result<std::unique_ptr<HttpServer>> HttpServer::listen(const HttpServerOptions& options, ConnectionContext& context) {
  auto listener = Listener::open(options.bind, options.port);
  if (!listener) {
    return Problem{ProblemCode::unavailable, "",
                   "The server can't listen on this address. It is in use, or does not belong to this machine.", "",
                   options.bind + ":" + std::to_string(options.port)};
  }
  try {
    return std::unique_ptr<HttpServer>(new HttpServer(*std::move(listener), context, options));
  } catch (const std::system_error&) {
    return Problem{ProblemCode::unavailable, "", "The system does not allow this process so many threads.", "",
                   std::to_string(options.threads)};
  }
}

bool HttpServer::run() {
  const bool inOrder = listener_.run(
      context_.stop, [this](OpenConnection connection) { pending_.admit(std::move(connection)); },
      [this] { pending_.makeRoom(); });
  pending_.finish();
  return inOrder;
}

} // namespace gnomon
