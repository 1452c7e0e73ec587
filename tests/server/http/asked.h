#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "server/http/connection.h"

namespace gnomon {

/// What a service replies, whether it refuses the head or answers the request.
inline HttpReply answerOf(const HttpService& service, const HttpRequest& request) {
  auto found = service(request);
  if (auto* reply = std::get_if<HttpReply>(&found)) return *reply;
  return std::get<RequestHandler>(found).answer(request, [] { return false; });
}

/// The first header of this name; empty where there is none.
inline std::string header(const HttpReply& reply, std::string_view name) {
  for (const auto& [key, value] : reply.headers) {
    if (key == name) return value;
  }
  return {};
}

} // namespace gnomon
