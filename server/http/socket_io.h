#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

enum class SocketWait { ready, closed, timedOut, stopped };

/// One client's bytes as they arrive. Waits no longer than a deadline, and buffers no more than it is asked for.
class SocketReader {
 public:
  /// `fd` still belongs to the caller; `stopFd` (or -1) ends waits with `endOnStop`.
  SocketReader(int fd, int stopFd) : fd_(fd), stopFd_(stopFd) {}

  /// Waits until something is buffered.
  SocketWait await(Clock::time_point deadline, bool endOnStop);

  /// Waits for more bytes than are buffered and appends at most `most` of them.
  SocketWait receive(std::size_t most, Clock::time_point deadline, bool endOnStop = false);

  std::string_view buffered() const { return std::string_view(buffer_).substr(begin_); }
  void consume(std::size_t count);

 private:
  int fd_;
  int stopFd_;
  std::string buffer_;
  std::size_t begin_ = 0; ///< bytes before it are consumed
};

/// Sends everything. False: the client was gone or too slow.
bool sendAll(int fd, std::string_view bytes, Clock::time_point deadline);

/// Closes the sending side and reads what the client still sends, so that a reset does not destroy the last reply.
void lingerAndClose(FileDescriptor socket, Clock::time_point deadline);

/// The other end's address without its port: "192.0.2.1", "2001:db8::1"; empty where there is none.
std::string peerAddress(int fd);

/// True when the peer has closed or reset the connection.
bool peerGone(int fd);

} // namespace gnomon
