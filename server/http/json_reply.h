#pragma once

#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "server/http/http_reply.h"

namespace gnomon {

/// Text from a scene need not be UTF-8: what is not is replaced.
inline std::string jsonText(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

inline HttpReply jsonReply(const Json& json, int status = 200) {
  HttpReply reply;
  reply.status = status;
  reply.contentType = "application/json";
  reply.body = jsonText(json);
  reply.headers.emplace_back("Cache-Control", "no-cache");
  return reply;
}

} // namespace gnomon
