#include "server/redis/stream.h"

#include <algorithm>
#include <cerrno>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <poll.h>
#include <sys/socket.h>

#include "server/redis/dial.h"

namespace gnomon::redis {
namespace {

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

} // namespace

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
