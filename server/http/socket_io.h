#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

enum class SocketWait { ready, closed, timedOut, cutOff };

/// One client's bytes as they arrive. Waits no longer than a deadline, and buffers no more than it is asked for.
class SocketReader {
 public:
  /// `fd` still belongs to the caller; `received` was read from it before.
  explicit SocketReader(int fd, std::string received = {}) : fd_(fd), buffer_(std::move(received)) {}

  /// Waits for more bytes than are buffered and appends at most `most` of them. cutOff: `cut` is raised.
  SocketWait receive(std::size_t most, Clock::time_point deadline, const StopSignal* cut = nullptr);

  std::string_view buffered() const { return std::string_view(buffer_).substr(begin_); }
  void consume(std::size_t count);

  /// What is buffered; nothing is afterwards.
  std::string take();

 private:
  int fd_;
  std::string buffer_;
  std::size_t begin_ = 0; ///< bytes before it are consumed
};

/// Bytes that were sent and that the other end's machine has not acknowledged. Of a Unix socket: about as many as the
/// other end has not read.
std::size_t unacknowledged(int fd);

/// Closing the connection then drops what was not acknowledged, and the other end learns of it by a reset.
void resetWhenClosed(int fd);

/// Whether a call that failed with this error may do better later.
bool mayComeLater(int error);

/// Sends what fits into the socket's buffer at once. False: not everything did, or the client was gone.
bool sendNow(int fd, std::string_view bytes);

/// Whether the client of one request still waits for the reply. Bytes that it sent ahead hide nothing. Any thread.
///
/// A client that has closed its connection and one that only says that it sends no more look the same (both send FIN),
/// until it is sent something: the first answers with a reset. So it is sent an interim reply, which every HTTP/1.1
/// client has to pass over (RFC 9110 section 15.2). HTTP/1.0 knows none: there only a reset counts.
class ClientWatch {
 public:
  /// `fd` still belongs to the caller, and is touched until end() at most.
  ClientWatch(int fd, bool knowsInterimReplies) : fd_(fd), mayAsk_(knowsInterimReplies) {}

  /// True once the client has left. The first call after its FIN waits some milliseconds for the reset.
  bool left();

  /// The reply begins, and is made while it is sent: from now on FIN counts as leaving.
  void beginStream();

  /// The reply is made. What left() said last stays.
  void end();

 private:
  bool isReset(int milliseconds) const;

  const int fd_;
  std::mutex mutex_;
  bool mayAsk_;
  bool streaming_ = false;
  bool ended_ = false;
  bool left_ = false;
};

} // namespace gnomon
