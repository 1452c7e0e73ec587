#include "server/redis/stream.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
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

/// Reads the system's errors of this thread, or the certificate's.
std::string tlsReason(const SSL* session) {
  const long verdict = session != nullptr ? SSL_get_verify_result(session) : X509_V_OK;
  if (verdict != X509_V_OK) return std::string("Its certificate is refused: ") + X509_verify_cert_error_string(verdict);
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return std::string("TLS failed: ") + (reason != nullptr ? reason : "the connection ended");
}

bool isNumeric(const std::string& host) {
  const std::unique_ptr<ASN1_OCTET_STRING, void (*)(ASN1_OCTET_STRING*)> octets(a2i_IPADDRESS(host.c_str()),
                                                                                ASN1_OCTET_STRING_free);
  return octets != nullptr;
}

/// The certificates that the session trusts. False where the system refuses.
bool expectHost(SSL* session, const std::string& host) {
  if (isNumeric(host)) return X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(session), host.c_str()) == 1;
  return SSL_set1_host(session, host.c_str()) == 1 && SSL_set_tlsext_host_name(session, host.c_str()) == 1;
}

/// A connected socket to a host, or why there is none.
struct Dialled {
  FileDescriptor socket; ///< does not block
  std::string reason{};  ///< where there is none: words for the log
};

/// Connects by TCP to the first address of the host that answers. Ends early once `cut` is raised; nullptr = never.
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

} // namespace

bool hasAuthorities(const std::string& file) {
  const std::unique_ptr<SSL_CTX, decltype(&::SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()), &::SSL_CTX_free);
  const bool found = context && SSL_CTX_load_verify_locations(context.get(), file.c_str(), nullptr) == 1;
  ERR_clear_error();
  return found;
}

bool waitFor(int fd, short events, Clock::time_point deadline, const StopSignal* cut) {
  while (true) {
    std::array<pollfd, 2> waiting{{{fd, events, 0}, {cut != nullptr ? cut->fd() : -1, POLLIN, 0}}};
    const int ready = ::poll(waiting.data(), waiting.size(), millisecondsUntil(deadline));
    if (ready < 0 && errno != EINTR) return false;
    if (ready > 0) return waiting[1].revents == 0;
    if (Clock::now() >= deadline) return false;
  }
}

Stream::Stream(FileDescriptor socket)
    : socket_(std::move(socket)), context_(nullptr, SSL_CTX_free), session_(nullptr, SSL_free) {}

/// Why it can't be encrypted; empty where it is.
std::string Stream::encrypt(const Address& address, Clock::time_point deadline, const StopSignal* cut) {
  ERR_clear_error();
  context_.reset(SSL_CTX_new(TLS_client_method()));
  if (!context_ || SSL_CTX_set_min_proto_version(context_.get(), TLS1_2_VERSION) != 1) return tlsReason(nullptr);
  SSL_CTX_set_verify(context_.get(), SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_mode(context_.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  const int trusted = address.authorities.empty()
                          ? SSL_CTX_set_default_verify_paths(context_.get())
                          : SSL_CTX_load_verify_locations(context_.get(), address.authorities.c_str(), nullptr);
  if (trusted != 1) return "The file of authorities can't be read";
  session_.reset(SSL_new(context_.get()));
  if (!session_ || !expectHost(session_.get(), address.host) || SSL_set_fd(session_.get(), socket_.get()) != 1) {
    return tlsReason(nullptr);
  }
  while (true) {
    const int done = SSL_connect(session_.get());
    if (done == 1) return {};
    const Moved moved = outcome(done);
    if (moved.isOver) return tlsReason(session_.get());
    if (!waitFor(socket_.get(), moved.waitsFor, deadline, cut)) return "TLS was not agreed on in time";
  }
}

OpenedStream Stream::open(const Address& address, Clock::time_point deadline, const StopSignal* cut) {
  Dialled dialled = dial(address.host, address.port, deadline, cut);
  if (!dialled.socket) return {nullptr, dialled.reason};
  std::unique_ptr<Stream> stream(new Stream(std::move(dialled.socket)));
  std::string reason = address.isEncrypted ? stream->encrypt(address, deadline, cut) : "";
  if (!reason.empty()) return {nullptr, std::move(reason)};
  return {std::move(stream)};
}

Moved Stream::outcome(int returned) {
  if (returned > 0) return {.bytes = static_cast<std::size_t>(returned)};
  switch (SSL_get_error(session_.get(), returned)) {
    case SSL_ERROR_WANT_READ:
      return {.waitsFor = POLLIN};
    case SSL_ERROR_WANT_WRITE:
      return {.waitsFor = POLLOUT};
    default:
      return {.isOver = true};
  }
}

Moved Stream::send(std::string_view bytes) {
  constexpr std::size_t kMost = 1 << 20;
  const int size = static_cast<int>(std::min(bytes.size(), kMost));
  if (size == 0) return {};
  if (session_) {
    ERR_clear_error();
    return outcome(SSL_write(session_.get(), bytes.data(), size));
  }
  const ssize_t count = ::send(socket_.get(), bytes.data(), static_cast<std::size_t>(size), MSG_NOSIGNAL);
  if (count >= 0) return {.bytes = static_cast<std::size_t>(count)};
  const bool later = errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
  return {.waitsFor = static_cast<short>(later ? POLLOUT : 0), .isOver = !later};
}

Moved Stream::receive(std::span<char> room) {
  if (session_) {
    ERR_clear_error();
    return outcome(SSL_read(session_.get(), room.data(), static_cast<int>(room.size())));
  }
  const ssize_t count = ::recv(socket_.get(), room.data(), room.size(), 0);
  if (count > 0) return {.bytes = static_cast<std::size_t>(count)};
  const bool later = count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  return {.waitsFor = static_cast<short>(later ? POLLIN : 0), .isOver = !later};
}

} // namespace gnomon::redis
