#pragma once

#include <cstddef>

#include "server/http/request.h"
#include "server/http/socket_io.h"
#include "server/system/byte_budget.h"

namespace gnomon {

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
