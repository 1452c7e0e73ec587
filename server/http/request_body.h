#pragma once

#include <atomic>

#include "server/http/request.h"
#include "server/http/socket_io.h"

namespace gnomon {

/// Bytes that all requests together may hold. Any thread.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : total_(bytes), left_(bytes) {}

  std::size_t total() const { return total_; }

  bool take(std::size_t bytes) {
    std::size_t left = left_.load();
    while (left >= bytes) {
      if (left_.compare_exchange_weak(left, left - bytes)) {
        return true;
      }
    }
    return false;
  }

  void giveBack(std::size_t bytes) { left_ += bytes; }

 private:
  const std::size_t total_;
  std::atomic<std::size_t> left_;
};

/// What one request holds of a budget; given back when it goes.
class ByteLease {
 public:
  explicit ByteLease(ByteBudget& budget) : budget_(&budget) {}
  ByteLease(const ByteLease&) = delete;
  ByteLease& operator=(const ByteLease&) = delete;
  ~ByteLease() { budget_->giveBack(held_); }

  bool grow(std::size_t bytes) {
    if (!budget_->take(bytes)) {
      return false;
    }
    held_ += bytes;
    return true;
  }

 private:
  ByteBudget* budget_;
  std::size_t held_ = 0;
};

/// The body that a route accepts.
struct BodyRule {
  enum class Framing {
    none,   ///< no body
    length, ///< no body, or one with a Content-Length; chunks are refused
    any     ///< a body with a Content-Length or in chunks
  };
  Framing framing = Framing::none;
  std::size_t maxBytes = 0;
};

/// How slowly a client may send or receive: after `grace`, at least this many bytes a second on average.
struct Pace {
  std::chrono::milliseconds stall{5'000}; ///< the longest wait for the next byte
  std::chrono::milliseconds grace{10'000};
  std::size_t bytesPerSecond = 16 * 1024;

  Clock::time_point deadline(Clock::time_point start, std::size_t bytes) const {
    return start + grace + std::chrono::milliseconds(bytes * 1000 / bytesPerSecond);
  }
};

/// Why the body that the head announces can't be accepted, before a byte of it is read or asked for: lengthRequired or
/// tooLarge. Nothing = it can.
std::optional<Problem> refuseBody(const RequestHead& head, const BodyRule& rule);

/// Reads the body that the head announces; never holds more than the rule allows. Problems: malformed (also where the
/// client hangs up), tooLarge, deadlineExceeded, and busy where the lease can't grow.
Result<Bytes> readBody(SocketReader& reader, const RequestHead& head, const BodyRule& rule, const Pace& pace,
                       ByteLease& lease);

} // namespace gnomon
