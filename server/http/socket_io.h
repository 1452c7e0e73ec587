#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// How slowly a client may send a body or take a reply.
struct Pace {
  std::chrono::milliseconds stall{5'000};   ///< the longest wait for the next byte
  std::chrono::milliseconds window{10'000}; ///< what is measured: bytes that passed earlier earn no time
  std::size_t bytesPerSecond = 16 * 1024;   ///< the least over each window
};

/// Holds one transfer to a pace. Its time is cut into windows.
class PaceMeter {
 public:
  PaceMeter(const Pace& pace, Clock::time_point start) : pace_(pace), windowStart_(start) {}

  void moved(std::size_t bytes, Clock::time_point now) {
    if (now >= windowStart_ + pace_.window) {
      windowStart_ = now;
      inWindow_ = 0;
    }
    inWindow_ += bytes;
  }

  /// When the transfer is too slow unless further bytes move.
  Clock::time_point deadline(Clock::time_point now) const {
    const bool enough = inWindow_ * 1000 >= pace_.bytesPerSecond * static_cast<std::size_t>(pace_.window.count());
    return enough ? now + pace_.stall : std::min(now + pace_.stall, windowStart_ + pace_.window);
  }

 private:
  const Pace pace_;
  Clock::time_point windowStart_;
  std::size_t inWindow_ = 0;
};

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

/// Sends everything. False: the client was gone or slower than the pace, or would have to be waited for when `cut` is
/// raised. `more`: other bytes follow at once, and may leave with these.
bool sendAll(int fd, std::string_view bytes, const Pace& pace, const StopSignal* cut = nullptr, bool more = false);

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
