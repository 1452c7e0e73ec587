#pragma once

#include <cstddef>
#include <string>

#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// The other end of a connection.
struct PeerAddress {
  std::string text;    ///< for the log: "192.0.2.7", "2001:db8::1"
  std::string network; ///< what counts as one client: the address, or the first 64 bits of one of IPv6
};

/// A client between two of its requests.
struct OpenConnection {
  FileDescriptor socket;
  PeerAddress peer;
  std::string received{};      ///< of the next request: bytes that have come already
  Clock::time_point arrived{}; ///< their first
  std::size_t requests = 0;    ///< answered so far
  bool ending = false;         ///< its last reply is sent: what still comes is passed over until the client closes

  /// Nothing of a request has come, or nothing but an empty line, which may precede it (RFC 9112 section 2.2).
  bool isSilent() const { return received.empty() || received == "\r" || received == "\r\n"; }
};

} // namespace gnomon
