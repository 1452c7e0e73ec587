#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/request.h"
#include "server/system/client_identity.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

/// The client's address behind trusted proxies.
namespace gnomon {

/// The other end of a connection.
struct PeerAddress {
  std::string text;        ///< for the log: "192.0.2.7", "2001:db8::1"
  ClientIdentity identity; ///< without a key
};

struct HeldReply;

/// A client between two of its requests, or whose reply waits.
struct OpenConnection {
  FileDescriptor socket;
  PeerAddress peer;
  std::string received{};      ///< of the next request: bytes that have come already
  Clock::time_point arrived{}; ///< their first
  std::size_t requests = 0;    ///< answered so far
  bool ending = false;         ///< its last reply is sent: what still comes is passed over until the client closes
  std::shared_ptr<HeldReply> held{}; ///< the reply that waits (waiting_replies.h), or goes on once it has a thread

  /// Nothing of a request has come, or nothing but an empty line, which may precede it (RFC 9112 section 2.2).
  bool isSilent() const { return !held && (received.empty() || received == "\r" || received == "\r\n"); }
};

/// An address of IPv4, or of IPv6. One of IPv4 that is written as IPv6 (::ffff:192.0.2.1) is one of IPv4.
struct IpAddress {
  bool isIpv6 = false;
  std::array<std::uint8_t, 16> bytes{}; ///< in network order; of IPv4 the first four

  bool operator==(const IpAddress&) const = default;
};

/// "192.0.2.7" or "2001:db8::1"; nothing where it is neither.
std::optional<IpAddress> ipAddress(std::string_view text);

PeerAddress peerAddress(const IpAddress& address);

/// Addresses that have their first bits in common.
struct IpNetwork {
  IpAddress first;
  int bits = 0;

  bool holds(const IpAddress& address) const;
};

/// Addresses and networks, as "192.0.2.7", "10.0.0.0/8" and "2001:db8::/32". A network whose bits after its length are
/// not 0 is a problem.
Result<std::vector<IpNetwork>> ipNetworks(const std::vector<std::string>& texts);

/// The client of a request: its peer, unless that is a trusted proxy. Then it is the last address that no trusted proxy
/// has, in X-Forwarded-For or Forwarded (RFC 7239), read from their ends: what is before it a client may have made up.
/// Reading ends at what is no address: then the client is the proxy that passed it on. So it is where both headers
/// came, and name different clients: a proxy writes one of them.
PeerAddress clientAddress(const PeerAddress& peer, const Headers& headers, const std::vector<IpNetwork>& trusted);

} // namespace gnomon
