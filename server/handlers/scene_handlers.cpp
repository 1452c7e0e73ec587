#include <nlohmann/json.hpp>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/http/reply.h"
#include "server/scenes/upload.h"
#include "server/wire/bundle.h"

namespace gnomon {
namespace {

HttpReply summaryReply(std::string summary, int status = 200) {
  HttpReply reply;
  reply.status = status;
  reply.contentType = "application/json";
  reply.body = std::move(summary);
  return reply;
}

/// Has a worker load the scene: its summary, or the reply that says why not.
HttpReply loadScene(Services& services, const RouteCall& call, const std::string& id, StoredBundle bundle) {
  Task task = taskFor(call, OrderKind::load, id, std::move(bundle), "", services.requestTimeout);
  task.lane = Lane::load;
  return replyOf(runTask(services, std::move(task), call.clientGone), call.request.id);
}

HttpReply store(Services& services, RouteCall& call, const std::optional<std::string>& expectedId) {
  auto bundle = bundleFromRequest(call.request, services.limits);
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  const auto pack = packed(*bundle);
  if (!pack) return problemReply(pack.problems(), call.request.id);
  bundle = SceneBundle();
  if (expectedId && *expectedId != pack->id) {
    return problemReply({{ProblemCode::hashMismatch, "",
                          "The SHA-256 of the uploaded bytes is not the one in the path.", *expectedId, pack->id}},
                        call.request.id);
  }
  bool isNew = false;
  auto summary = services.store.contains(pack->id) ? services.store.summary(pack->id) : std::nullopt;
  if (!summary) {
    HttpReply loaded = loadScene(services, call, pack->id, {pack->file});
    if (loaded.status != 200) return loaded;
    const auto kept = services.store.put(pack->id, pack->file, pack->bytes, loaded.body);
    if (!kept) return problemReply(kept.problems(), call.request.id);
    isNew = *kept;
    if (!isNew) services.store.keepSummary(pack->id, loaded.body); // the one beside it could not be used
    summary = std::move(loaded.body);
  }
  HttpReply reply = summaryReply(*std::move(summary), isNew ? 201 : 200);
  reply.headers.emplace_back("Location", "/v1/scenes/" + pack->id);
  return reply;
}

/// The scene's summary as it was stored, or as a worker makes it.
HttpReply summaryOf(Services& services, const RouteCall& call, const std::string& id) {
  if (!services.store.contains(id)) return problemReply({unknownScene(id)}, call.request.id);
  if (auto stored = services.store.summary(id)) return summaryReply(*std::move(stored));
  auto bundle = services.store.bundle(id);
  if (!bundle) return problemReply(bundle.problems(), call.request.id);
  HttpReply made = loadScene(services, call, id, *std::move(bundle));
  if (made.status == 200) services.store.keepSummary(id, made.body);
  return made;
}

} // namespace

HttpReply postScene(Services& services, RouteCall call) {
  return store(services, call, std::nullopt);
}

HttpReply putScene(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (!isSceneId(id)) {
    return problemReply({{ProblemCode::invalidValue, "id", "The path must end with the SHA-256 of the upload.",
                          "64 lower-case hexadecimal digits", asciiExcerpt(id)}},
                        call.request.id);
  }
  return store(services, call, id);
}

HttpReply listScenes(Services& services, RouteCall call) {
  std::string all;
  for (const std::string& id : services.store.ids()) {
    const HttpReply summary = summaryOf(services, call, id);
    if (summary.status == 200) all += (all.empty() ? "" : ",") + summary.body;
  }
  return summaryReply("{\"scenes\":[" + all + "]}");
}

HttpReply getScene(Services& services, RouteCall call) {
  return summaryOf(services, call, call.values.at("id"));
}

HttpReply deleteScene(Services& services, RouteCall call) {
  const std::string& id = call.values.at("id");
  if (!services.store.remove(id)) return problemReply({unknownScene(id)}, call.request.id);
  services.workers.forget(id);
  HttpReply reply;
  reply.status = 204;
  return reply;
}

} // namespace gnomon
