#pragma once

#include "server/http/http_service.h"
#include "server/http/socket_io.h"

namespace gnomon {

/// How long a client may take, and how often it may ask over one connection.
struct ConnectionLimits {
  std::chrono::milliseconds firstByte{5'000}; ///< from connecting to the first byte
  std::chrono::milliseconds head{5'000};      ///< from the first byte of a request to the end of its head, in all
  std::chrono::milliseconds idle{2'000};      ///< between two requests
  std::chrono::milliseconds linger{2'000};    ///< for what a refused client still sends
  Pace pace;                                  ///< bodies, both ways
  std::size_t maxRequests = 10'000;
};

/// What every connection of a server shares. Outlives them all.
struct ConnectionContext {
  HttpService service;
  ConnectionLimits limits;
  ByteBudget bodyBytes;
  StopSignal stop; ///< once raised: no further request is read, the running one is answered
};

/// Serves one client until it leaves, is too slow, or the server stops. Throws nothing.
void serveConnection(FileDescriptor socket, ConnectionContext& context) noexcept;

/// The request that a head describes, without its body. Its id is the client's where that is well formed.
Result<HttpRequest> requestFromHead(const RequestHead& head);

} // namespace gnomon
