#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "server/system/clock.h"

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

} // namespace gnomon
