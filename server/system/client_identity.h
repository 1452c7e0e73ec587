#pragma once

#include <string>

namespace gnomon {

/// Who a request counts against wherever something is shared: threads, bytes, places in queues, jobs.
struct ClientIdentity {
  std::string
      name{}; ///< "key NAME"; without keys the address, "192.0.2.7", or the network of one of IPv6, "2001:db8::/64"
  std::string site{}; ///< of an IPv6 address the network that one customer has, "2001:db8::/48"; else the name

  bool operator==(const ClientIdentity&) const = default;
};

} // namespace gnomon
