#pragma once

#include <cstddef>

#include "server/http/request.h"
#include "server/http/socket_io.h"
#include "server/http/transfer_pace.h"
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

/// Why the body that the head announces can't be accepted, before a byte of it is read or asked for: lengthRequired or
/// tooLarge. `allBodies`: bytes that there are for bodies. Nothing = it can.
std::optional<Problem> refuseBody(const RequestHead& head, const BodyRule& rule, std::size_t allBodies);

/// Reads the body that the head announces; never holds more than the rule allows. Problems: malformed (also where the
/// client hangs up), tooLarge, deadlineExceeded, busy where the lease can't grow now, and unavailable where `cut` is
/// raised before the body is there.
Result<Bytes> readBody(SocketReader& reader, const RequestHead& head, const BodyRule& rule, const Pace& pace,
                       ByteLease& lease, const StopSignal* cut = nullptr);

} // namespace gnomon
