#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/result.h"

namespace gnomon::redis {

/// Where a Redis server is, and as which user to connect.
struct Address {
  std::string host;          ///< a name, or an IPv4 or IPv6 address without brackets
  std::uint16_t port = 6379; ///< 1..65535
  std::string user;          ///< empty = the default user
  std::string password;      ///< empty = none is sent
  int database = 0;          ///< 0..65535
  bool isEncrypted = false;  ///< TLS: the server's certificate has to be valid for `host`
  std::string authorities;   ///< a PEM file of authorities that may sign that certificate; empty = the system's
};

/// Whether a text is meant to be an address, rather than a path.
bool isAddress(std::string_view text);

/// `redis://[[user]:password@]host[:port][/database]`, or `rediss://...` for TLS. User and password may have percent
/// escapes. Problems: invalidValue, which never repeats the text, since there may be a password in it.
Result<Address> parseAddress(std::string_view text);

/// The address as it may be shown to anyone: without user and password.
std::string shownText(const Address& address);

/// The first line of a file, which is a password. Problems: invalidValue where there is none, or more than 4,096 bytes.
Result<std::string> passwordFrom(const std::string& file);

} // namespace gnomon::redis
