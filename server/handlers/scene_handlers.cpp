#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/handlers/handlers.h"
#include "server/http/reply.h"
#include "server/scenes/bundle.h"

namespace gnomon {
namespace {

HttpReply store(Services& services, HttpRequest& request, const std::optional<std::string>& expectedId) {
  const auto bundle = bundleFromRequest(request, services.limits);
  if (!bundle) {
    return problemReply(bundle.problems(), request.id);
  }
  const auto stored = services.store.put(*bundle, expectedId);
  if (!stored) {
    return problemReply(stored.problems(), request.id);
  }
  HttpReply reply = jsonReply(toJson(stored->loaded.summary), stored->isNew ? 201 : 200);
  reply.headers.emplace_back("Location", "/v1/scenes/" + stored->loaded.summary.id);
  return reply;
}

} // namespace

HttpReply postScene(Services& services, RouteCall call) {
  return store(services, call.request, std::nullopt);
}

HttpReply putScene(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (!isSceneId(id)) {
    return problemReply({{ProblemCode::invalidValue, "id", "The path must end with the SHA-256 of the upload.",
                          "64 lower-case hexadecimal digits", asciiExcerpt(id)}},
                        call.request.id);
  }
  return store(services, call.request, id);
}

HttpReply listScenes(Services& services, RouteCall) {
  return jsonReply(toJson(services.store.summaries()));
}

HttpReply getScene(Services& services, RouteCall call) {
  const auto summary = services.store.summary(call.values.at("id"));
  return summary ? jsonReply(toJson(*summary)) : problemReply(summary.problems(), call.request.id);
}

HttpReply deleteScene(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (!services.store.remove(id)) {
    return problemReply({unknownScene(id)}, call.request.id);
  }
  HttpReply reply;
  reply.status = 204;
  return reply;
}

} // namespace gnomon
