#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "server/redis/address.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

struct ssl_ctx_st;
struct ssl_st;

namespace gnomon::redis {

/// Waits until a descriptor has one of the events of poll(2); false where the deadline comes first or `cut` is raised.
bool waitFor(int fd, short events, Clock::time_point deadline, const StopSignal* cut);

/// Whether a PEM file has certificates of authorities.
bool hasAuthorities(const std::string& file);

/// What an attempt to move bytes came to.
struct Moved {
  std::size_t bytes = 0;
  short waitsFor = 0;  ///< the event of poll(2) without which it can't go on; 0 = none
  bool isOver = false; ///< the connection has ended, in order or not
};

struct OpenedStream;

/// Bytes to a server and back, plain or by TLS. Never blocks but while it is opened. One thread. The process has to
/// ignore SIGPIPE.
class Stream {
 public:
  /// Connects; with TLS, checks the server's certificate and name.
  static OpenedStream open(const Address& address, Clock::time_point deadline, const StopSignal* cut);

  int fd() const { return socket_.get(); }
  Moved send(std::string_view bytes);
  Moved receive(std::span<char> room);

 private:
  using Context = std::unique_ptr<ssl_ctx_st, void (*)(ssl_ctx_st*)>;
  using Session = std::unique_ptr<ssl_st, void (*)(ssl_st*)>;

  explicit Stream(FileDescriptor socket);
  std::string encrypt(const Address& address, Clock::time_point deadline, const StopSignal* cut);
  Moved outcome(int returned);

  FileDescriptor socket_;
  Context context_;
  Session session_; ///< nullptr = plain
};

/// A stream, or why there is none.
struct OpenedStream {
  std::unique_ptr<Stream> stream;
  std::string reason{}; ///< words for the log
};

} // namespace gnomon::redis
