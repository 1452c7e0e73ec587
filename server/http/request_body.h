#pragma once

#include "server/http/byte_budget.h"
#include "server/http/request_head.h"
#include "server/http/socket_io.h"

namespace gnomon {

/// What a route takes for a body.
struct BodyRule {
  enum class Framing {
    none,   ///< no body
    length, ///< none, or one with a Content-Length; chunks are refused
    any     ///< one, with a Content-Length or in chunks
  };
  Framing framing = Framing::none;
  std::size_t maxBytes = 0;
};

/// How slowly a client may send or receive: `grace`, and then on average this many bytes a second.
struct Pace {
  std::chrono::milliseconds stall{5'000}; ///< the longest wait for the next byte
  std::chrono::milliseconds grace{10'000};
  std::size_t bytesPerSecond = 16 * 1024;

  Clock::time_point deadline(Clock::time_point start, std::size_t bytes) const {
    return start + grace + std::chrono::milliseconds(bytes * 1000 / bytesPerSecond);
  }
};

/// Why a body was not read. The status is the wire's own (RFC 9110): 400 408 411 413 429.
struct BodyRefusal {
  int status = 400;
  Problem problem;
};

/// What the head alone tells about the body, before a byte of it is read or asked for.
std::optional<BodyRefusal> refuseBody(const RequestHead& head, const BodyRule& rule);

/// Reads the body that the head announces; never holds more than the rule allows. A closed connection is status 400.
std::variant<Bytes, BodyRefusal> readBody(SocketReader& reader, const RequestHead& head, const BodyRule& rule,
                                          const Pace& pace, ByteLease& lease);

} // namespace gnomon
