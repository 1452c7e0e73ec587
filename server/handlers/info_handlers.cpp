#include "server/handlers/info_handlers.h"

#include "protocol/openapi/openapi.h"
#include "server/frames/etag.h"
#include "server/http/json_reply.h"
#include "server/http/problem_reply.h"
#include "server/scenes/sha256.h"

namespace gnomon {
namespace {

/// The page runs its own scripts and styles, talks to this server and shows its pictures; nothing else.
constexpr std::string_view kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'self'";

HttpReply textReply(std::string text) {
  HttpReply reply;
  reply.contentType = "text/plain; charset=utf-8";
  reply.body = std::move(text);
  reply.headers.emplace_back("Cache-Control", "no-store");
  return reply;
}

} // namespace

HttpReply getCapabilities(Services& services, RouteCall) {
  return jsonReply(toJson(Capabilities{GNOMON_VERSION, services.queue.info(), services.limits}));
}

HttpReply getOpenApi(Services&, RouteCall) {
  return jsonReply(openApi());
}

HttpReply getLivez(Services&, RouteCall) {
  return textReply("alive\n");
}

HttpReply getReadyz(Services& services, RouteCall call) {
  const char* reason = services.draining           ? "The server is shutting down."
                       : !services.queue.hasRoom() ? "The render queue is nearly full."
                                                   : nullptr;
  if (reason != nullptr) {
    return problemReply({{ProblemCode::unavailable, "", reason, "", ""}}, call.request.id);
  }
  return textReply("ready\n");
}

std::function<HttpReply(RouteCall)> pageHandler(const StaticFile& file) {
  Sha256 hash;
  hash.add(file.bytes);
  return [file, etag = '"' + hash.hex() + '"'](const RouteCall& call) {
    HttpReply reply;
    reply.headers = {{"ETag", etag},
                     {"Cache-Control", "no-cache"},
                     {"Content-Security-Policy", std::string(kPagePolicy)},
                     {"Referrer-Policy", "no-referrer"}};
    const auto known = headerValue(call.request.headers, "if-none-match");
    if (known && etagMatches(*known, etag)) {
      reply.status = 304;
      return reply;
    }
    reply.contentType = file.contentType;
    reply.body = file.bytes;
    return reply;
  };
}

} // namespace gnomon
