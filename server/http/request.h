#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "server/http/url.h"
#include "server/system/byte_budget.h"
#include "server/system/client_identity.h"
#include "server/system/clock.h"

namespace gnomon {

inline constexpr std::size_t kMaxHeadBytes = 32 * 1024; ///< request line and headers, with the closing empty line
inline constexpr std::size_t kMaxHeaders = 100;
inline constexpr std::string_view kWholeServer = "*"; ///< the target of OPTIONS that names no path

/// Headers in the order of the request; names are lower case.
using Headers = std::vector<std::pair<std::string, std::string>>;

/// The values of header `name` (lower case), joined by ", " where it is repeated.
std::optional<std::string> headerValue(const Headers& headers, std::string_view name);

/// The media type of a Content-Type, lower case, without its parameters.
std::string mediaType(std::string_view contentType);

/// The part of a request before its body (RFC 9112).
struct RequestHead {
  std::string method;
  std::string target; ///< origin form, or kWholeServer; an absolute form is cut, and its authority replaces the Host
  Headers headers;
  std::optional<std::uint64_t> contentLength; ///< absent = no body, or a chunked one
  bool chunked = false;
  bool isHttp11 = true; ///< false: HTTP/1.0
  bool keepAlive = true;
  bool expectsContinue = false; ///< never of HTTP/1.0

  bool hasBody() const { return chunked || contentLength.value_or(0) > 0; }
};

/// The length of the head at the front of `bytes`, its empty line included, or up to a line that ends with LF alone, by
/// which it is malformed; nothing while it is incomplete.
std::optional<std::size_t> headLength(std::string_view bytes);

/// The first line of a head that may be malformed or incomplete, as far as it can be read, in visible ASCII.
struct HeadExcerpt {
  std::string method; ///< empty = it begins with none
  std::string target;
};
HeadExcerpt excerptOf(std::string_view bytes);

/// Parses a head that ends with its empty line; another one may precede it. Strict where servers in a chain could
/// disagree about the end of a body: line ends are CR LF; folded lines, repeated lengths, and a length together with
/// chunks are malformed.
Result<RequestHead> parseRequestHead(std::string_view bytes);

/// Where a request stands in a trace (request_log.h).
struct TraceContext {
  std::string traceId;  ///< 32 lower-case hexadecimal digits; empty = the request has none
  std::string spanId;   ///< 16 such digits: this request
  std::string parentId; ///< 16 such digits: the sender's span; empty = this request begins the trace
  bool sampled = false; ///< the sender keeps the trace
};

/// One request, every byte of it bounded and its syntax checked.
struct HttpRequest {
  std::string id;                ///< X-Request-ID: the client's where it is well formed, else a new one
  std::string method;            ///< upper case
  std::string target;            ///< as it came, without a scheme and authority
  std::vector<std::string> path; ///< percent-decoded segments; "/" and kWholeServer have none
  Query query;
  Headers headers;
  bool hasBody = false; ///< the head announces a body
  Bytes body;
  TraceContext trace;
  ClientIdentity client;
  std::string key;                          ///< the name of its key; empty = the server has none
  bool isAdmin = false;                     ///< its key has the scope admin
  Clock::time_point arrived = Clock::now(); ///< its first byte
};

/// For whom the request holds bytes.
inline Holder holderOf(const HttpRequest& request) {
  return {request.client, request.id};
}

/// The request that a head describes, without its body.
Result<HttpRequest> requestFromHead(const RequestHead& head);

/// The client's id where it is 1..128 letters, digits or -._: (nothing that could forge a log line); else a new one.
std::string requestId(const std::optional<std::string>& offered);

} // namespace gnomon
