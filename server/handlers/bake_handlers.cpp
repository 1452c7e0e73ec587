#include <array>
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
