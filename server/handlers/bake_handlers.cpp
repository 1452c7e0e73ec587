#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "protocol/bake/bake_json.h"
#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "server/bakes/bake_run.h"
#include "server/handlers/event_reply.h"
#include "server/handlers/handlers.h"
#include "server/http/negotiation.h"
#include "server/http/reply.h"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 2> kReportForms{"application/json", kEventStream};
constexpr std::size_t kReportAsEvents = 1;

/// Bakes, and puts progress and the result as events.
void putBakeEvents(BakeRun& run, const std::function<bool()>& gone, const std::string& requestId, EventStream& events) {
  constexpr std::chrono::milliseconds kPause{100};
  auto told = Clock::time_point::min();
  int light = -1;
  const auto listener = [&](const BakeStep& step) {
    if (step.light != light || Clock::now() - kPause >= told) {
      events.put("progress", jsonText(toJson(step)));
      told = Clock::now();
    }
    light = step.light;
    return true;
  };
  const auto report = run.report(gone, listener);
  events.put(report ? "result" : "problem",
             report ? jsonText(toJson(*report)) : problemText(report.problems(), requestId));
}

/// The index in ?light=; nothing where there is none.
Result<std::optional<int>> lightOf(const HttpRequest& request) {
  std::optional<int> light;
  for (const auto& [key, value] : request.query) {
    const Problem unknown{ProblemCode::invalidValue, "/" + asciiExcerpt(key), "There is no query key of this name.",
                          "light", ""};
    if (key != "light" || light) {
      return unknown;
    }
    int index = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), index);
    if (error != std::errc() || end != value.data() + value.size() || index < 0) {
      return Problem{ProblemCode::invalidValue, "/light", "This is no index of a light.", "0, 1, 2, ...",
                     asciiExcerpt(value)};
    }
    light = index;
  }
  return light;
}

Problem unknownBake(const BakeName& name) {
  return {ProblemCode::notFound, "key", "No bake with this key is done.", "", asciiExcerpt(name.key)};
}

BakeName nameOf(const RouteCall& call) {
  return {call.values.at("id"), call.values.at("key")};
}

} // namespace

HttpReply postBake(Services& services, RouteCall call) {
  const auto deadline = Clock::now() + services.bakes.timeout;
  const std::string& id = call.values.at("id");
  const std::string requestId = call.request.id;
  if (!services.store.contains(id)) {
    return problemReply({unknownScene(id)}, requestId);
  }
  const auto spec = decodeFrameSpec(call.request.body.empty() ? "{}" : asText(call.request.body));
  if (!spec) {
    return problemReply(spec.problems(), requestId);
  }
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kReportForms);
  if (!form) {
    return problemReply({{ProblemCode::notAcceptable, "", "A bake can't be told as any media type that Accept lists.",
                          "application/json, text/event-stream", asciiExcerpt(accept.value_or(""))}},
                        requestId);
  }
  auto scene = services.store.get(id);
  if (!scene) {
    return problemReply(scene.problems(), requestId);
  }
  auto run = BakeRun::start(services.bakes, *std::move(scene), *spec, deadline);
  if (!run) {
    return problemReply(run.problems(), requestId, {.retryAfterSeconds = kBakeRetrySeconds});
  }
  HttpReply reply;
  if (*form == kReportAsEvents) {
    reply =
        eventReply(call, [run = *std::move(run), requestId](const std::function<bool()>& gone, EventStream& events) {
          putBakeEvents(*run, gone, requestId, events);
        });
  } else {
    const auto report = (*run)->report(call.clientGone);
    if (!report) {
      return problemReply(report.problems(), requestId, {.retryAfterSeconds = kBakeRetrySeconds});
    }
    reply.contentType = kReportForms[*form];
    reply.body = jsonText(toJson(*report));
  }
  reply.headers.emplace_back("Cache-Control", "no-store"); // says whether the maps were there already
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

HttpReply getBake(Services& services, RouteCall call) {
  const std::string requestId = call.request.id;
  const BakeName name = nameOf(call);
  if (!services.store.contains(name.scene)) {
    return problemReply({unknownScene(name.scene)}, requestId);
  }
  const auto spec = services.bakes.book.find(name);
  if (!spec) {
    return problemReply({unknownBake(name)}, requestId);
  }
  const auto light = lightOf(call.request);
  if (!light) {
    return problemReply(light.problems(), requestId);
  }
  const auto accept = headerValue(call.request.headers, "accept");
  const auto form = preferred(accept, kBakeFileTypes);
  if (!form) {
    return problemReply({{ProblemCode::notAcceptable, "", "A bake can't be sent as any media type that Accept lists.",
                          "image/png, image/x-exr, model/gltf-binary", asciiExcerpt(accept.value_or(""))}},
                        requestId);
  }
  const auto scene = services.store.get(name.scene);
  if (!scene) {
    return problemReply(scene.problems(), requestId);
  }
  const auto file = bakedFile(services.bakes, *scene, *spec, static_cast<BakeFile>(*form), *light, call.clientGone);
  if (!file) {
    return problemReply(file.problems(), requestId, {.retryAfterSeconds = kBakeRetrySeconds});
  }
  HttpReply reply;
  reply.contentType = kBakeFileTypes[*form];
  reply.body = asText(*file);
  reply.headers.emplace_back("Cache-Control", "private, no-cache");
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

HttpReply deleteBake(Services& services, RouteCall call) {
  const BakeName name = nameOf(call);
  if (!services.bakes.book.remove(name)) {
    return problemReply(
        {{ProblemCode::notFound, "key", "No bake with this key is in progress or done.", "", asciiExcerpt(name.key)}},
        call.request.id);
  }
  HttpReply reply;
  reply.status = 204;
  return reply;
}

} // namespace gnomon
