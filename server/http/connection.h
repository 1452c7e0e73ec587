#pragma once

#include <functional>
#include <variant>

#include "server/http/reply.h"
#include "server/http/request_body.h"
#include "server/http/socket_io.h"

namespace gnomon {

/// What answers one request. Knows nothing of sockets.
struct RequestHandler {
  BodyRule body;
  bool isProbe = false; ///< answered however busy everything else is: it reads a few atomics and returns

  /// The reply. `clientGone` may be called at any time, by any thread that the handler waits for.
  std::function<HttpReply(HttpRequest, const std::function<bool()>& clientGone)> answer;
};

/// Finds the handler of a request by its head alone, or gives the reply that refuses it. Many threads at once.
using HttpService = std::function<std::variant<RequestHandler, HttpReply>(const HttpRequest&)>;

/// How long a client may take, and how many requests it may send over one connection.
struct ConnectionLimits {
  std::chrono::milliseconds firstByte{5'000}; ///< from connecting to the first byte
  std::chrono::milliseconds head{5'000};      ///< from the first byte of a request to the end of its head, in all
  std::chrono::milliseconds idle{2'000};      ///< between two requests
  std::chrono::milliseconds linger{2'000};    ///< for what a client still sends after a refusal
  Pace pace;                                  ///< bodies, both ways
  std::size_t maxRequests = 10'000;
};

/// What all connections of a server share. Outlives them.
struct ConnectionContext {
  HttpService service;
  ConnectionLimits limits;
  ByteBudget bodyBytes;
  StopSignal stop; ///< once raised: no further request is read, the running one is answered
};

/// Serves one client until it leaves, is too slow, or the server stops. Throws nothing.
void serveConnection(FileDescriptor socket, ConnectionContext& context) noexcept;

} // namespace gnomon
