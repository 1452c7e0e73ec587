#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
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

} // namespace gnomon
