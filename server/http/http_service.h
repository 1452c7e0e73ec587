#pragma once

#include <functional>
#include <variant>

#include "server/http/http_reply.h"
#include "server/http/http_request.h"
#include "server/http/request_body.h"

namespace gnomon {

/// What answers requests; knows nothing of sockets. Called from many threads at once.
struct HttpService {
  /// What the request may bring, told by its head alone; or the reply that refuses it.
  std::function<std::variant<BodyRule, HttpReply>(const HttpRequest&)> admit;

  /// The reply. `clientGone` may be asked at any time, by any thread that the handler waits for.
  std::function<HttpReply(HttpRequest, const std::function<bool()>& clientGone)> handle;

  /// Routes that must be answered however busy everything else is: they read a few atomics and return.
  std::function<bool(const HttpRequest&)> isProbe;
};

} // namespace gnomon
