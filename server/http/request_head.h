#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.h"
#include "server/http/http_request.h"

namespace gnomon {

inline constexpr std::size_t kMaxHeadBytes = 32 * 1024; ///< request line and headers, with the closing empty line
inline constexpr std::size_t kMaxHeaders = 100;

/// What stands before a request's body (RFC 9112).
struct RequestHead {
  std::string method;
  std::string target; ///< origin form; an absolute form is cut to it
  Headers headers;
  std::optional<std::uint64_t> contentLength; ///< absent = no body, or a chunked one
  bool chunked = false;
  bool keepAlive = true;
  bool expectsContinue = false;
};

/// Parses a head that ends with its empty line. Strict where servers in a chain could disagree about where a body
/// ends: line ends are CR LF, folded lines, repeated lengths and a length beside chunks are malformed.
Result<RequestHead> parseRequestHead(std::string_view bytes);

/// The length of the head at the front of `bytes`, its empty line included; nothing while it is incomplete.
std::optional<std::size_t> headLength(std::string_view bytes);

} // namespace gnomon
